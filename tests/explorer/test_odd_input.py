"""The page on odd input: HTML in names, NaN and infinities, extremes; and by keyboard only."""

import ast

import pytest

NAMES = [
    "<img src=x onerror=alert(1)>",
    "&lt;b&gt; \"quoted\" 'twice' \\ %41+#=&",
    "record:\n:\u2028\u202e🏛",
    "__proto__",
]
NUMBERS = ["NaN", "-inf", "1e999", "-1e999", "0x10", "1e", "1_0", "１", "٣", "1,000.5", "--1", ""]
# The histories at both ends of each field: whether all of their numbers are what they have to be.
EXTREMES = """Object.keys(SHAPES).concat("record").flatMap(shape => CHOICES.eq.flatMap(eq =>
  CHOICES.cap.flatMap(cap => Object.keys(FIELDS).flatMap(key => ["least", "most"].flatMap(end => {
    const each = {...DEFAULTS, shape, eq, cap, record: "el_centro_1940_NS"};
    each[key] = FIELDS[key][end];
    if (contradiction(each)) return [];
    const {times, ground, displacement, structures} = histories(each, fileOf(each));
    const isSound = [times, ground, displacement].every(all => all.every(Number.isFinite))
      && structures.every(of => Number.isNaN(of.peak) === of.overturned
        && of.theta.every((theta, k) => Number.isFinite(theta) || times[k] > of.flatAt)
        && !(of.moved && eq === "exact" && Number.isNaN(of.friction)));
    return [[shape, eq, cap, key, end, isSound]];
  })))))"""
HEADER = "time (s),acceleration (g)\n"
RECORD = HEADER + "".join(f"{k / 50},{0.3 * (-1) ** (k // 25)}\n" for k in range(99))
SHAPE = """(() => {
  const select = document.getElementById("shape");
  select.value = {0};
  select.dispatchEvent(new Event("change"));
  return state.shape;
})()"""
TEXT = "document.getElementById({0}).textContent"
IN_ADDRESS = """Object.keys(FIELDS).filter(key => {
  const {state: next, faults} = decode(new URLSearchParams({[key]: {0}}).toString());
  return next[key] !== DEFAULTS[key] || !faults[key];
})"""


@pytest.mark.parametrize("name", NAMES)
def test_name_of_a_record_is_only_ever_a_text(browser, name):
    browser.open()
    assert browser.drop(f"{name}.csv", RECORD) == ""
    browser.settle()
    assert browser.do("state.record") == name
    assert browser.do(SHAPE, "half-sine") == "half-sine"
    assert browser.do(SHAPE, f"record:{name}") == "record"
    browser.settle("minima")
    nodes = ast.walk(ast.parse(browser.do(TEXT, "python")))
    texts = [node.value for node in nodes if isinstance(node, ast.Constant)]
    assert f"data/records/{name}.csv" in texts
    assert browser.drop(f"{name} 2.csv", f"{name},a\n").startswith(f"{name} 2.csv: line 1 is ")
    assert browser.do("document.querySelectorAll('main img').length") == 0
    browser.open(browser.do("location.hash.slice(1)"))
    assert f"the record “{name}” is not in this page" in browser.do(TEXT, "shape-error")
    assert browser.do("document.querySelectorAll('main img').length") == 0
    assert browser.errors == []


def test_what_is_no_finite_number_is_refused_in_every_field(browser):
    browser.open_to_compute()
    taken = {text: browser.do(IN_ADDRESS, text) for text in NUMBERS}
    assert {text: keys for text, keys in taken.items() if keys} == {"1e999": ["g"]}  # γ → ∞


def test_address_that_names_what_every_object_has_is_as_if_it_did_not(browser):
    browser.open("toString=1&__proto__=2&constructor=3&h=2")
    assert "h=2&" in browser.do("encode(state)")
    assert browser.errors == []


def test_histories_are_finite_at_both_ends_of_every_field(browser):
    browser.open_to_compute()
    found = browser.do(EXTREMES)
    assert len(found) > 400
    assert [row for row in found if not row[-1]] == []


def press(browser, key, code, text=""):
    """Press a key of the keyboard, and let it go."""
    of = {"key": key, "code": key, "windowsVirtualKeyCode": code}
    kind = "keyDown" if text else "rawKeyDown"
    browser.ask("Input.dispatchKeyEvent", type=kind, **of, **({"text": text} if text else {}))
    browser.ask("Input.dispatchKeyEvent", type="keyUp", **of)


def reach(browser, is_there):
    """Press the tabulator until the focus is where a condition on `at` holds."""
    for _ in range(80):
        press(browser, "Tab", 9)
        if browser.do(f"(at => !!({is_there}))(document.activeElement)"):
            return
    raise AssertionError(f"no Tab reaches {is_there}")


def test_everything_is_done_with_the_keyboard_only(browser, tmp_path):
    browser.open()
    browser.do("document.activeElement.blur()")
    reach(browser, "at.closest('#cases') && at.previousElementSibling")
    press(browser, "Enter", 13, "\r")
    assert browser.do("CASES.indexOf(encode(state))") == 1
    browser.settle()
    reach(browser, "at.id === 'h'")
    browser.ask("Input.insertText", text="2.5")  # in place of what is selected
    assert browser.do("state.h") == 2.5
    reach(browser, "at.name === 'cap'")
    press(browser, "ArrowDown", 40)
    assert browser.do("state.cap") == "fixed"
    reach(browser, "at.id === 'shape'")
    press(browser, "End", 35)
    assert browser.do("state.shape") == "record"
    path = tmp_path / "mine.csv"
    path.write_text(RECORD, encoding="utf-8")
    reach(browser, "at.textContent.startsWith('Open a record')")
    browser.answer(path, lambda: press(browser, "Enter", 13, "\r"))
    browser.read()
    assert browser.do("state.record") == "mine"
    browser.settle("spectrum")
    reach(browser, "at.id === 'spectrum'")
    before = browser.do("planeOf(state, fileOf(state)).here")
    for key, code in (("ArrowUp", 38), ("ArrowRight", 39), ("ArrowRight", 39), ("ArrowLeft", 37)):
        press(browser, key, code)
    after = browser.do("planeOf(state, fileOf(state)).here")
    assert after["y"] / before["y"] == pytest.approx((12 / 0.93) ** (1 / 36), rel=1e-3)
    assert after["x"] / before["x"] == pytest.approx(40 ** (1 / 48), rel=1e-3)
    reach(browser, "at.tagName === 'SUMMARY'")
    press(browser, "Enter", 13, "\r")
    assert browser.do("document.activeElement.parentElement.open") is True
    assert browser.errors == []
