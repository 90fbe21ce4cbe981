"""What people cry to a robot in other languages than English. Data only.

Each language has what ends everything ("stop") and what halts a robot that moves ("wait",
"careful", "no", "enough"), in its own script and as typed without it. They count only where
nothing else is said (:mod:`intents.stopping`, :mod:`intents.halting`), so a word that means
something in another language ("para", "vent") is still that word in a sentence.
"""

STOPS = {
    "arabic": "توقف,توقفي,توقفوا,قف,قفي,لا تتحرك,qif,tawaqaf,tawaqqaf,la tataharrak,la tatharak",
    "bengali": "থামো,থামুন,থাম,দাঁড়াও,thamo,thamun,tham,darao,daraon",
    "bulgarian": "спри,спрете,стоп,не мърдай,spri,sprete,ne murdai,ne mardai",
    "catalan": "atura't,atura,pareu,para't,no et moguis",
    "chinese": "停,停下,停下来,停住,停止,快停,别动,不要动,站住,住手,ting,tingxia,ting xia,"
    "ting xialai,tingzhi,bie dong,biedong,zhan zhu,zhanzhu,zhu shou",
    "croatian and serbian": "stani,stanite,zaustavi se,stoj,ne miči se,ne mrdaj,стани,станите,"
    "заустави се,не мрдај",
    "czech and slovak": "stůj,stůjte,stoj,zastav,zastavte,zastav se,zastaň,zastavit,nehýbej se,"
    "nehýb sa,přestaň,prestaň",
    "danish and norwegian": "stop,stopp,stans,stands,stå stille,sta stille,staa stille,hold op,"
    "ikke rør dig,ikke rør deg",
    "dutch": "stop,stoppen,sta stil,blijf staan,halt,ophouden,hou op,houd op,niet bewegen",
    "filipino": "hinto,huminto ka,tigil,tumigil ka,itigil mo,huwag kang gumalaw",
    "finnish": "seis,pysähdy,pysähtykää,pysäytä,lopeta,älä liiku,stop",
    "french": "arrête,arrêtez,arrête-toi,arrêtez-vous,arrêter,stop,halte,halte-là,stoppe,"
    "ne bouge pas,ne bouge plus,ne bougez pas,ne bougez plus,bouge pas,bouge plus,arrête ça",
    "german": "stopp,halt,halt an,halte an,anhalten,stehen bleiben,stehenbleiben,bleib stehen,"
    "bleiben sie stehen,steh still,stillgestanden,nicht bewegen,beweg dich nicht,keine bewegung,"
    "hör auf,hoer auf,aufhören,aufhoeren,lass das,abbruch,abbrechen,not aus,notaus,nothalt",
    "greek": "σταμάτα,σταματήστε,σταμάτησε,στοπ,ακίνητος,μην κουνιέσαι,αλτ,stamata,stamatiste,"
    "stamatise,min kouniese,akinitos",
    "hebrew": "עצור,עצרי,עצרו,תעצור,תעצרי,עמוד,אל תזוז,atzor,atsor,atzri,taatzor,al tazuz",
    "hindi and urdu": "रुको,रुकें,रुकिए,रुकिये,रुक,रुक जाओ,रुक जाइए,ठहरो,ठहरिए,ठहर जाओ,थम जाओ,"
    "बंद करो,मत हिलो,हिलना मत,رکو,رک جاؤ,رکیں,ٹھہرو,ruko,rukko,ruk,ruk jao,ruk jaao,rukiye,"
    "rukjao,ruk ja,thahro,thehro,tehro,thahr jao,theher jao,band karo,mat hilo,hilna mat",
    "hungarian": "állj,álljon meg,állj meg,megállj,megállni,stop,ne mozdulj,hagyd abba",
    "indonesian and malay": "berhenti,berhentilah,setop,stop,henti,jangan bergerak,diam di tempat",
    "italian": "fermati,fermatevi,si fermi,fermo,ferma,fermi,fermo li,ferma li,fermo lì,alt,"
    "stop,basta,non muoverti,non ti muovere,non si muova,smettila",
    "japanese": "止まれ,止まって,止まってください,止まれよ,とまれ,とまって,止めて,止めろ,"
    "ストップ,停止,動くな,動かないで,tomare,tomatte,tomete,yamero,ugokuna,ugokanaide,sutoppu",
    "korean": "멈춰,멈춰요,멈춰라,멈추세요,멈춰 주세요,정지,스톱,서,거기 서,움직이지 마,"
    "meomchwo,meomchwoyo,meomchuseyo,meomcheo,jeongji",
    "persian": "ایست,بایست,وایسا,توقف کن,تکان نخور,vaysa,bayest,tavaghof kon",
    "polish": "stój,stójcie,stop,zatrzymaj się,zatrzymaj,zatrzymać,nie ruszaj się,przestań",
    "portuguese": "pare,pára,para,parem,parar,alto,pare já,para já,pare aí,para aí,fique parado,"
    "fica parado,fica quieto,quieto,não se mexa,nao se mexa,não te mexas,detenha-se",
    "romanian": "oprește,oprește-te,opriți,opriți-vă,stai,stai pe loc,stop,nu te mișca",
    "russian": "стоп,стой,стойте,стоять,остановись,остановитесь,остановить,останови,замри,"
    "не двигайся,не двигаться,прекрати,stoi,stoy,stoyat,stoj,ostanovis,zamri,ne dvigaisya,"
    "ne dvigaysya",
    "spanish": "para,pare,párate,parate,pará,pára ya,para ya,paren,parad,parar,alto,alto ahí,"
    "detente,detén,deten,deténgase,detenerse,quieto,quieta,estate quieto,quédate quieto,"
    "no te muevas,no se mueva,no se muevan,basta,frena",
    "swahili": "simama,simameni,usisogee,komesha",
    "swedish": "stopp,stanna,stå still,sta still,stilla,sluta,rör dig inte,stop",
    "tamil": "நில்,நில்லு,நில்லுங்கள்,நிறுத்து,நிறுத்துங்கள்,nillu,nillunga,niruthu,niruthungal",
    "telugu": "ఆగు,ఆగండి,ఆపు,aagu,aagandi,aapu,agu,agandi",
    "thai": "หยุด,หยุดนะ,หยุดเดี๋ยวนี้,หยุดก่อน,อย่าขยับ,yut,yud,yoot",
    "turkish": "dur,durun,dursana,durdur,durdurun,hareket etme,kımıldama,kimildama",
    "ukrainian": "стій,стійте,стоп,зупинись,зупиніться,не рухайся,stiy,stii,stij,zupynys,"
    "zupynis,ne rukhaysya",
    "vietnamese": "dừng,dừng lại,đứng lại,đứng yên,ngừng lại,ngừng,dung lai,dung,ngung lai,"
    "dung yen",
}
"""What ends whatever the robot is at."""

HALTS = {
    "arabic": "انتظر,انتظري,احذر,انتبه,لا,كفى,يكفي,مهلا,لا تلمس,intazir,intadhir,intabih,ihdhar,"
    "kafa,kafi,khalas,خلاص",
    "bengali": "অপেক্ষা করো,সাবধান,না,যথেষ্ট,opekkha koro,shabdhan,sabdhan",
    "bulgarian": "чакай,чакайте,внимавай,не,достатъчно,стига,chakai,vnimavai,stiga",
    "catalan": "espera,compte,prou,no,vigila",
    "chinese": "等,等等,等一下,等一等,慢点,小心,当心,不,不要,不行,不对,够了,别,别碰,等会儿,deng,"
    "deng yixia,deng deng,dengdeng,dengyixia,xiaoxin,bu,bu yao,buyao,bu xing,bu dui,gou le,goule,"
    "bie",
    "croatian and serbian": "čekaj,cekaj,pričekaj,pazi,oprez,ne,dosta,nemoj,чекај,пази,не,доста,"
    "немој",
    "czech and slovak": "počkej,počkejte,počkaj,čekej,pozor,ne,nie,dost,stačí,opatrně,nech toho",
    "danish and norwegian": "vent,vent lidt,vent litt,pas på,pass på,forsigtig,forsiktig,nej,"
    "nei,nok,det er nok,ikke det",
    "dutch": "wacht,wacht even,pas op,voorzichtig,nee,genoeg,kijk uit,niet doen,niet dat,rustig",
    "filipino": "teka,teka lang,sandali,sandali lang,hintay,ingat,huwag,tama na,wag",
    "finnish": "odota,odottakaa,varo,varovasti,ei,riittää,riittaa,älä,ala tee,hetkinen",
    "french": "pas si vite,attends,attendez,attention,fais attention,faites attention,doucement,"
    "non,ça suffit,assez,un instant,un moment,une seconde,pas ça,pas celui-là,pas là,"
    "prudence,gare,"
    "non non,touche pas,ne touche pas,laisse,laisse ça",
    "german": "warte,warten sie,wart mal,warte mal,moment,moment mal,einen moment,augenblick,"
    "vorsicht,vorsichtig,achtung,pass auf,passen sie auf,aufpassen,nein,nee,nö,genug,es reicht,"
    "das reicht,nicht,nicht das,nicht da,nicht so,nicht so schnell,langsam,finger weg,bloß nicht,"
    "lass es,sachte",
    "greek": "περίμενε,περιμένετε,πρόσεχε,προσοχή,όχι,αρκετά,φτάνει,μη,perimene,prosexe,"
    "proseche,prosochi,oxi,ochi,arketa,ftanei",
    "hebrew": "חכה,חכי,רגע,זהירות,תיזהר,לא,מספיק,די,אל,chake,haki,rega,zehirut,tizaher,maspik,dai",
    "hindi and urdu": "इंतज़ार करो,इंतजार करो,सावधान,संभल के,संभलकर,ध्यान से,नहीं,बस,बस करो,"
    "मत करो,मत,एक मिनट,ज़रा रुको,نہیں,بس,خبردار,انتظار کرو,intezar karo,intazar karo,savdhan,"
    "saavdhan,sambhal ke,sambhalke,dhyan se,dhyaan se,nahi,nahin,nahi nahi,bas,bas karo,mat karo,"
    "ek minute,ek minat,arre",
    "hungarian": "várj,várjon,várj egy kicsit,vigyázz,vigyázat,óvatosan,nem,elég,ne,ne azt",
    "indonesian and malay": "tunggu,tunggu sebentar,sebentar,awas,hati-hati,hati hati,tidak,tak,"
    "jangan,cukup,bukan itu,pelan-pelan",
    "italian": "piano piano,non così veloce,aspetta,aspetti,aspettate,attento,attenta,"
    "attenzione,fai attenzione,no,"
    "un attimo,un momento,un secondo,non quello,non quella,non lì,non toccare,non farlo,occhio,"
    "calma,così no,lascia,lascia stare",
    "japanese": "待って,待ってください,待て,ちょっと待って,まって,危ない,あぶない,気をつけて,"
    "だめ,ダメ,いや,いいえ,違う,ちがう,やめて,やめろ,もういい,matte,chotto matte,abunai,dame,iie,"
    "chigau,yamete,kiwotsukete,ki o tsukete",
    "korean": "잠깐,잠깐만,잠깐만요,기다려,기다려요,기다리세요,조심,조심해,조심하세요,위험해,"
    "안 돼,안돼,안돼요,아니,아니요,아니야,그만,그만해,그만하세요,하지 마,하지마,jamkkan,"
    "jamkkanman,gidaryeo,josim,josimhae,andwae,ani,aniyo,geuman,geumanhae,hajima,haji ma",
    "persian": "صبر کن,مواظب باش,مراقب باش,نه,کافیه,بسه,نکن,sabr kon,movazeb bash,na,basse,nakon",
    "polish": "czekaj,poczekaj,zaczekaj,chwila,chwileczkę,uważaj,ostrożnie,uwaga,nie,dość,"
    "wystarczy,nie to,nie tam,zostaw,zostaw to",
    "portuguese": "não tão rápido,espera,espere,esperem,espera aí,espere aí,calma,cuidado,"
    "atenção,devagar,não,"
    "nao,chega,já chega,um momento,um segundo,um instante,isso não,esse não,aí não,não faça isso,"
    "larga,deixa,não mexe,não toque,basta",
    "romanian": "așteaptă,asteapta,așteptați,stai puțin,stai putin,ai grijă,ai grija,atenție,"
    "atentie,nu,ajunge,destul,nu asta,încet",
    "russian": "подожди,подождите,погоди,жди,осторожно,аккуратно,внимание,нет,не надо,не то,"
    "не туда,не трогай,хватит,достаточно,берегись,минутку,тише,podozhdi,pogodi,ostorozhno,"
    "ne nado,khvatit,hvatit,beregis,tishe",
    "spanish": "no tan rápido,espera,espere,esperen,espérate,aguarda,cuidado,ten cuidado,"
    "tenga cuidado,ojo,atención,despacio,tranquilo,no,ya basta,suficiente,ya está,"
    "un momento,un segundo,momento,"
    "eso no,ese no,así no,ahí no,no toques,no toques eso,no hagas eso,déjalo,suelta,no no",
    "swahili": "ngoja,subiri,subiri kidogo,angalia,tahadhari,hapana,inatosha,usifanye,polepole",
    "swedish": "vänta,vänta lite,akta,akta dig,se upp,försiktigt,nej,nog,det räcker,inte det,"
    "inte den,inte där,låt bli",
    "tamil": "பொறு,பொறுங்கள்,கவனம்,பார்த்து,வேண்டாம்,இல்லை,போதும்,poru,porunga,kavanam,paathu,"
    "vendam,venda,illai,podhum,pothum",
    "telugu": "జాగ్రత్త,వద్దు,చాలు,కాదు,jagratha,jagratta,vaddu,chalu,kadu",
    "thai": "รอ,รอก่อน,รอเดี๋ยว,เดี๋ยว,เดี๋ยวก่อน,ระวัง,ไม่,ไม่ใช่,อย่า,พอ,พอแล้ว,ro kon,"
    "raw gon,diao kon,rawang,mai,mai chai,ya tham,pho laeo,pho laew",
    "turkish": "bekle,bekleyin,bir dakika,bir saniye,dikkat,dikkat et,dikkatli ol,hayır,hayir,"
    "yeter,yapma,yavaş,yavas,o değil,o degil,dokunma,bırak",
    "ukrainian": "чекай,зачекай,почекай,обережно,увага,ні,не треба,досить,не те,не туди,chekai,"
    "chekay,zachekai,pochekai,oberezhno,dosyt",
    "vietnamese": "chờ,chờ đã,chờ một chút,đợi,đợi đã,khoan,khoan đã,cẩn thận,coi chừng,không,"
    "đừng,đủ rồi,thôi,cho da,doi da,khoan da,can than,coi chung,khong,du roi,thoi",
}
"""What halts a robot that moves: wait, careful, no, enough, not that."""

AROUND = (
    "bhai,bhaiya,ji,yaar,arre,um pouco,un poco,un peu,un po',kurz,dulu,amigo,roboter,robô,"
    "please,now,robot,hey,oh,ah,ya,ahora,ya mismo,por favor,señor,oye,ey,agora,já,ja,jetzt,"
    "sofort,bitte,mal,doch,schon,maintenant,tout de suite,s'il te plaît,s'il vous plaît,svp,là,"
    "subito,ora,adesso,per favore,per piacere,nu,nå,nu direct,alsjeblieft,alstublieft,snälla,"
    "heti,proszę,teraz,natychmiast,prosím,teď,hned,пожалуйста,сейчас,немедленно,будь ласка,зараз,"
    "te rog,acum,azonnal,kérem,παρακαλώ,τώρα,lütfen,hemen,şimdi,من فضلك,الآن,בבקשה,עכשיו,कृपया,"
    "अभी,yahan,abhi,kripya,अरे,यहाँ,दया,请,快,请你,立刻,ください,今すぐ,제발,지금,xin,ngay,"
    "tolong,sekarang,tafadhali,sasa,ครับ,ค่ะ,นะ,da,ahi,aqui,aí,aquí,hier,ici,qui,lì,e"
)
"""What may be said with it: please, now, here."""

STEMS_OF_STOPS = (
    "停下 停住 快停 别动 別動 站住 止まっ 止まれ 止めて 動くな 動かない 멈춰 멈추 움직이지 หยุด"
)
"""What says stop anywhere in a short text of a script that is written without blanks, or whose
verbs have many endings."""

STEMS_OF_HALTS = (
    "停 等等 等一 小心 当心 不要 别碰 住手 待って 待て 危ない 気をつけ やめ だめ ダメ 기다 조심 "
    "잠깐 그만 위험 하지 안돼 ระวัง เดี๋ยว อย่า รอก่อน"
)
"""The same of what halts."""
