// Letting something go wrong in simulation: a few at a press, and every other as a form. It is the
// prompt's `inject` that is said.

const AT_A_PRESS = [
  ["Shove it forwards", "shove strength_n_s=8"],
  ["Shove it to its left", "shove strength_n_s=8 towards_deg=90"],
  ["Camera says nothing for 3 s", "silence topic=camera duration_s=3"],
  ["Lidar says nothing for 3 s", "silence topic=lidar duration_s=3"],
  ["The next plan takes too long", "slow_planner"],
];
const OF_WHAT = { target: ["object", "person", "furniture"], motor: "motors", topic: ["camera", "lidar", "imu", "force"] };

const faults = {
  forms: [],

  build() {
    const quick = $("fault-quick");
    quick.replaceChildren();
    const somebody = page.scene && page.scene.bodies.find((body) => body.role === "person");
    const held = page.scene && page.scene.bodies.find((body) => body.role === "object");
    const more = [];
    if (somebody) more.push([`${somebody.name} stands in the way for 6 s`, `stand_in_way target=${somebody.id} duration_s=6`]);
    if (held) more.push([`${held.name} falls over`, `knock_over target=${held.id}`]);
    for (const [text, words] of [...AT_A_PRESS, ...more]) {
      const button = element("button", "", text);
      button.type = "button";
      button.title = `inject ${words}`;
      button.onclick = () => this.say(words);
      quick.append(button);
    }
    const kinds = $("fault-kind");
    kinds.replaceChildren(...this.forms.map((form) => { const made = element("option", "", form.name.replaceAll("_", " ")); made.value = form.name; return made; }));
    this.form();
  },

  form() {
    const form = this.forms.find((one) => one.name === $("fault-kind").value), box = $("fault-keys");
    box.replaceChildren();
    if (!form) return;
    $("fault-help").textContent = form.help;
    for (const [name, needed, usual] of form.keys) {
      const row = element("label", "", ""), input = element("input");
      input.name = name;
      input.required = needed;
      input.autocomplete = "off";
      input.placeholder = needed ? "needed" : usual || "left out";
      const names = this.names(name);
      if (names.length) {
        const list = element("datalist");
        list.id = `fault-${name}`;
        list.append(...names.map((one) => { const made = element("option"); made.value = one; return made; }));
        input.setAttribute("list", list.id);
        row.append(list);
      }
      row.prepend(element("span", "", name.replaceAll("_", " ")), input);
      box.append(row);
    }
  },

  names(key) {
    const kinds = OF_WHAT[key];
    if (!kinds || !page.scene) return [];
    if (kinds === "motors") return page.scene.motor_names;
    if (key === "topic") return kinds;
    return page.scene.bodies.filter((body) => kinds.includes(body.role)).map((body) => body.id);
  },

  send() {
    const words = [...$("fault-keys").querySelectorAll("input")].filter((input) => input.value.trim()).map((input) => `${input.name}=${input.value.trim().replace(/\s+/g, "")}`);
    this.say([$("fault-kind").value, ...words].join(" "));
  },

  say(words) {
    order(`inject ${words}`);
    $("fault-said").textContent = `inject ${words}`;
  },
};
