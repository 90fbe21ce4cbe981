"""Other programs' files: behaviour trees in XML, and lists of waypoints."""

from tests.hostile.cases import OUTSIDE, Case, Expect, Make
from tests.hostile.corpus.shapes import DIGITS, NAMES
from tests.hostile.exam import exam

HEAD = '<root BTCPP_format="4" main_tree_to_execute="M"><BehaviorTree ID="M">'
TAIL = "</BehaviorTree></root>"


def _tree(inside: str) -> str:
    return HEAD + inside + TAIL


def _leaf(attributes: str, name: str = "Say") -> str:
    return _tree(f"<Sequence><{name} {attributes}/></Sequence>")


def _ten_times(number: int) -> str:
    calls = f'<SubTree ID="T{number + 1}"/>' * 10
    return f'<BehaviorTree ID="T{number}"><Sequence>{calls}</Sequence></BehaviorTree>'


def _chain(count: int, between: int) -> str:
    """Trees that call one another, each through some Sequences."""
    before, after = "<Sequence>" * between, "</Sequence>" * between
    trees = (
        f'<BehaviorTree ID="T{number}">{before}<SubTree ID="T{number + 1}"/>{after}</BehaviorTree>'
        for number in range(count)
    )
    last = f'<BehaviorTree ID="T{count}"><Sleep msec="1000"/></BehaviorTree>'
    root = '<root BTCPP_format="4" main_tree_to_execute="T0">'
    return root + "".join(trees) + last + "</root>"


def _includes(count: int, inside: str) -> dict[str, str]:
    """A file that includes many, each of which includes the next one, too."""
    files = {
        f"i{number}.xml": f'<root BTCPP_format="4"><include path="i{number + 1}.xml"/>{inside}</root>'
        for number in range(count)
    }
    names = "".join(f'<include path="i{number}.xml"/>' for number in range(count))
    return {"t.xml": HEAD.replace("<BehaviorTree", names + "<BehaviorTree", 1) + TAIL, **files}


def _elements(count: int) -> str:
    return f'<BehaviorTree ID="B">{"<a/>" * count}</BehaviorTree>'


LAUGHS = (
    '<!DOCTYPE r [<!ENTITY a "ha">'
    + "".join(f'<!ENTITY a{i} "{f"&a{i - 1};" * 10 if i else "&a;"}">' for i in range(10))
    + "]>"
)
TREES: dict[str, str | bytes | Make] = {
    "empty": "",
    "text": "no XML at all",
    "open": "<root><BehaviorTree",
    "no-root": "<html/>",
    "no-tree": '<root BTCPP_format="4"/>',
    "no-format": '<root><BehaviorTree ID="M"><AlwaysSuccess/></BehaviorTree></root>',
    "format-3": '<root BTCPP_format="3"><BehaviorTree ID="M"><AlwaysSuccess/></BehaviorTree></root>',
    "format-digits": f'<root BTCPP_format="{DIGITS}"/>',
    "main-missing": '<root BTCPP_format="4" main_tree_to_execute="X"><BehaviorTree ID="M"/></root>',
    "laughs": LAUGHS + _tree("<Say message='&a9;'/>"),
    "quadratic": f'<!DOCTYPE r [<!ENTITY a "{"a" * 100_000}">]>' + _tree("<Say message='" + "&a;" * 10_000 + "'/>"),
    "entity-passwd": '<!DOCTYPE r [<!ENTITY x SYSTEM "file:///etc/passwd">]>' + _tree("<Say message='x'/>&x;"),
    "entity-http": '<!DOCTYPE r [<!ENTITY x SYSTEM "http://127.0.0.1:9/x">]>' + _tree("&x;"),
    "entity-parameter": '<!DOCTYPE r [<!ENTITY % x SYSTEM "file:///etc/passwd"> %x;]>' + _tree(""),
    "doctype-system": '<!DOCTYPE r SYSTEM "file:///etc/passwd">' + _tree("<AlwaysSuccess/>"),
    "stylesheet": '<?xml-stylesheet href="file:///etc/passwd"?>' + _tree("<Nobody/>"),
    "encoding-unknown": '<?xml version="1.0" encoding="ebcdic-x"?>' + _tree("<AlwaysSuccess/>"),
    "encoding-utf-7": b'<?xml version="1.0" encoding="utf-7"?>' + _tree("+ADw-Nobody/+AD4-").encode(),
    "encoding-utf-32": _tree("<Nobody/>").encode("utf-32"),
    "version-9": '<?xml version="9.0"?>' + _tree("<Nobody/>"),
    "include-missing": '<root BTCPP_format="4" main_tree_to_execute="M"><include path="nowhere.xml"/>'
    '<BehaviorTree ID="M"><AlwaysSuccess/></BehaviorTree></root>',
    "include-secret": f'<root BTCPP_format="4"><include path="{OUTSIDE}/secret.txt"/></root>',
    "include-dots": '<root BTCPP_format="4"><include path="../outside/secret.txt"/></root>',
    "include-zeros": '<root BTCPP_format="4"><include path="/dev/zero"/></root>',
    "include-itself": '<root BTCPP_format="4"><include path="t.xml"/></root>',
    "include-escape": '<root BTCPP_format="4"><include path="&#x9b;31m"/></root>',
    "include-package": '<root BTCPP_format="4"><include ros_pkg="../../etc" path="passwd"/></root>',
    "xinclude": '<root BTCPP_format="4" xmlns:xi="http://www.w3.org/2001/XInclude">'
    '<xi:include href="/etc/passwd" parse="text"/></root>',
    "deep-5000": _tree("<Sequence>" * 5000 + "<AlwaysSuccess/>" + "</Sequence>" * 5000),
    "deep-200": _tree("<Inverter>" * 200 + "<AlwaysSuccess/>" + "</Inverter>" * 200),
    "deep-attributes": _tree("<Say " + " ".join(f'a{i}="x"' for i in range(50_000)) + "/>"),
    "wide-30000": _tree("<Sequence>" + "<AlwaysSuccess/>" * 30_000 + "</Sequence>"),
    "subtree-itself": _tree('<SubTree ID="M"/>'),
    "subtree-missing": _tree('<SubTree ID="N"/>'),
    "subtree-circle": '<root BTCPP_format="4" main_tree_to_execute="M">'
    '<BehaviorTree ID="M"><SubTree ID="N"/></BehaviorTree>'
    '<BehaviorTree ID="N"><SubTree ID="M"/></BehaviorTree></root>',
    "subtree-doubling": '<root BTCPP_format="4" main_tree_to_execute="T0">'
    + "".join(_ten_times(i) for i in range(9))
    + '<BehaviorTree ID="T9"><AlwaysSuccess/></BehaviorTree></root>',
    "subtree-port-escape": _tree('<SubTree ID="N" x="&#x9b;31m{y}"/>'),
    "id-twice": '<root BTCPP_format="4"><BehaviorTree ID="M"><AlwaysSuccess/></BehaviorTree>'
    '<BehaviorTree ID="M"><AlwaysFailure/></BehaviorTree></root>',
    "two-children": _tree("<AlwaysSuccess/><AlwaysSuccess/>"),
    "unknown-leaf": _tree("<Explode/>"),
    "unknown-c1": _tree('<Action ID="&#x9b;31m"/>'),
    "unknown-bidi": _tree('<Action ID="&#x202e;gnp"/>'),
    "unknown-long": _tree(f"<{'x' * 1_900_000}/>"),
    "name-bidi": _tree('<Explode name="&#x202e;gnp"/>'),
    "script": _tree('<Script code="x := 1"/>'),
    "pre-condition": _tree('<AlwaysSuccess _skipIf="x==1"/>'),
    "reactive": _tree("<ReactiveSequence><AlwaysSuccess/></ReactiveSequence>"),
    "json-open": _leaf('message="json:{bad"'),
    "json-deep": _leaf(f'message="json:{"[" * 3000}"'),
    "json-deep-closed": _leaf(f'message="json:{"[" * 3000}{"]" * 3000}"'),
    "json-digits": _leaf(f'message="json:{DIGITS}"'),
    "json-nan": _leaf('message="json:NaN"'),
    "json-escape": _leaf('message="json:&quot;\\u001b[2J&quot;"'),
    "json-surrogate": _leaf('message="json:&quot;\\ud800&quot;"'),
    "pose-json": _leaf('goal="json:{bad"', "GoTo"),
    "pose-nan": _leaf('goal="nan;nan;nan"', "NavigateToPose"),
    "repeat-digits": _tree(f'<Repeat num_cycles="{DIGITS}"><AlwaysSuccess/></Repeat>'),
    "repeat-minus": _tree('<Repeat num_cycles="-1"><AlwaysSuccess/></Repeat>'),
    "repeat-word": _tree('<Repeat num_cycles="often"><AlwaysSuccess/></Repeat>'),
    "repeat-nan": _tree('<Repeat num_cycles="nan"><AlwaysSuccess/></Repeat>'),
    "repeat-none": _tree("<Repeat><AlwaysSuccess/></Repeat>"),
    "retry-digits": _tree(f'<RetryUntilSuccessful num_attempts="{DIGITS}"><AlwaysSuccess/></RetryUntilSuccessful>'),
    "timeout-word": _tree('<Timeout msec="soon"><AlwaysSuccess/></Timeout>'),
    "timeout-digits": _tree(f'<Timeout msec="{DIGITS}"><AlwaysSuccess/></Timeout>'),
    "timeout-inf": _tree('<Timeout msec="inf"><AlwaysSuccess/></Timeout>'),
    "delay-minus": _tree('<Delay delay_msec="-5"><AlwaysSuccess/></Delay>'),
    "delay-nan": _tree('<Delay delay_msec="nan"><AlwaysSuccess/></Delay>'),
    "parallel-count": _tree(f'<Parallel success_count="{DIGITS}"><AlwaysSuccess/></Parallel>'),
    "nul": _tree("<Say message='a'/>").replace("Say", "S\x00y"),
    "control": _tree("<Say message='\x01\x1b[2J'/>"),
    "cdata": _tree("<![CDATA[<Say/>]]>"),
    "words-escape": _tree('<Sequence>&#x9b;31m<Say text="a"/></Sequence>'),
    "words-bidi": _tree('<Sequence>&#x202e;gnp<Say text="a"/></Sequence>'),
    "words-long": _tree("x" * 1_900_000 + '<Say text="a"/>'),
    "comment-flood": _tree("<!--" + "x" * 3_000_000 + "-->"),
    "gigantic-attribute": _leaf(f'message="{"x" * 3_000_000}"'),
    "fallback-15000": _tree("<Fallback>" + '<Sleep msec="1000"/>' * 15_000 + "</Fallback>"),
    "retries": _tree('<RetryUntilSuccessful num_attempts="2">' * 90 + '<Sleep msec="1"/>' + "</RetryUntilSuccessful>" * 90),
    "subtree-chain-1500": _chain(1500, 0),
    "subtree-chain-30-deep": _chain(30, 50),
    "model-only": '<root BTCPP_format="4"><TreeNodesModel><Action ID="X"/></TreeNodesModel></root>',
}  # fmt: skip
LENIENT = {
    "no-format", "stylesheet", "quadratic", "cdata", "comment-flood", "gigantic-attribute", "deep-200",
    "doctype-system", "main-missing", "deep-attributes",
}  # fmt: skip
"""May be read as far as it goes: what counts is that nothing else is, and that it ends."""

POSE = "{header: {frame_id: map}, pose: {position: {x: 1, y: 2, z: 0}, orientation: {w: 1}}}"
POINTS: dict[str, str | bytes | Make] = {
    "empty": "",
    "null": "waypoints: ~\n",
    "word": "waypoints: here\n",
    "number": "waypoints: 3\n",
    "empty-list": "waypoints: []\n",
    "nulls": "waypoints: [~, ~]\n",
    "nan": "waypoints: {waypoint0: {pose: [.nan, 0, 0], orientation: [1, 0, 0, 0]}}\n",
    "inf": "waypoints: {waypoint0: {pose: [.inf, 0, 0], orientation: [1, 0, 0, 0]}}\n",
    "1e300": "waypoints: {waypoint0: {pose: [1.0e+300, 0, 0], orientation: [1, 0, 0, 0]}}\n",
    "digits": f"waypoints: {{waypoint0: {{pose: [{DIGITS}, 0, 0], orientation: [1, 0, 0, 0]}}}}\n",
    "pose-word": "waypoints: {waypoint0: {pose: far, orientation: [1, 0, 0, 0]}}\n",
    "pose-short": "waypoints: {waypoint0: {pose: [1], orientation: [1, 0, 0, 0]}}\n",
    "pose-map": "waypoints: {waypoint0: {pose: {x: {}}, orientation: []}}\n",
    "orientation-zero": "waypoints: {waypoint0: {pose: [1, 0, 0], orientation: [0, 0, 0, 0]}}\n",
    "orientation-nan": "waypoints: {waypoint0: {pose: [1, 0, 0], orientation: [.nan, 0, 0, 0]}}\n",
    "orientation-words": "waypoints: {waypoint0: {pose: [1, 0, 0], orientation: [a, b, c, d]}}\n",
    "frame-odom": f"poses: [{POSE.replace('map', 'odom')}]\n",
    "frame-escape": 'poses: ["\\e[2J"]\n',
    "frame-list": f"poses: [{POSE.replace('map', '[map]')}]\n",
    "poses-deep": "poses: " + "[" * 3000 + "]" * 3000 + "\n",
    "poses-aliases": f"poses: [&p {POSE}" + ", *p" * 10 + "]\n",
    "name-escape": 'waypoints: {"\\e[2J": {pose: [x, 0, 0], orientation: [1, 0, 0, 0]}}\n',
    "position-word": f"poses: [{POSE.replace('x: 1', 'x: one')}]\n",
    "position-null": f"poses: [{POSE.replace('x: 1', 'x: ~')}]\n",
    "many": "poses:\n" + f"  - {POSE}\n" * 25_000,
    "many-wrong": "poses:\n" + f"  - {POSE.replace('x: 1', 'x: one')}\n" * 900,
    "tag": "poses: !!python/object/apply:os.system ['touch owned']\n",
}
CASES = [
    *(
        Case(
            name=f"tree-{name}",
            argv=("mission", "import", "t.xml"),
            files={"t.xml": content},
            expect=Expect.ENDS if name in LENIENT else Expect.REFUSED,
            says=("t.xml",),
        )
        for name, content in TREES.items()
    ),
    *(
        Case(
            name=f"points-{name}",
            argv=("mission", "import", "p.yaml"),
            files={"p.yaml": content},
            says=("p.yaml",),
        )
        for name, content in POINTS.items()
    ),
    *(
        Case(
            name=f"includes-{name}",
            argv=("mission", "import", "t.xml"),
            files=_includes(count, inside),
            says=("50 files", "50000 elements"),
        )
        for name, count, inside in (
            ("chain", 1500, ""),
            ("elements", 40, _elements(49_000)),
            ("letters", 40, f'<BehaviorTree ID="B"><a b="{"x" * 1_900_000}"/></BehaviorTree>'),
        )
    ),
    *(
        Case(
            name=f"tree-text-{name}",
            argv=("mission", "import", "t.xml", "-o", "out.yaml"),
            files={"t.xml": _leaf(f'message="{text}"', "Explode")},
            says=("t.xml",),
        )
        for name, text in {
            "format": NAMES["format"],
            "markup": "[link=x]y[/link][/]",
            "separator": "a\u2028b",
            "bidi": NAMES["bidi"],
        }.items()
    ),
    *(
        Case(
            name=f"output-{name}",
            argv=("mission", "import", "t.xml", "-o", path),
            files={
                "t.xml": _tree('<Say message="hello"/>'),
            },
        )
        for name, path in {"folder": ".", "nowhere": "a/b/c.yaml"}.items()
    ),
]
test_import = exam("imports", CASES)
