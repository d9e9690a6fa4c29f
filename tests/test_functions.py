"""The page of the functions has every public name, in a user's order, and no internals."""

import re

import pytest

import topheavy
from documents import functions


@pytest.fixture(scope="module")
def text():
    return functions.page(functions.described(), {}, "")


def test_each_public_name_has_one_place_in_the_order_of_the_package(text):
    listed = [name for names in functions.headings().values() for name in names]
    assert re.findall(r'<section id="([\w.]+)"', text) == listed
    assert {name.split(".")[0] for name in listed} == set(topheavy.__all__)
    assert listed.index("Column") < listed.index("Pulse") < listed.index("simulate")


def test_signatures_name_no_module_and_no_alias_of_numpy(text):
    signatures = re.findall('(?s)<div class="attr .*?</div>', text)
    words = re.sub("<[^>]+>", "", " ".join(signatures))
    assert "excitation: Pulse | Record" in words
    assert not re.search(r"topheavy\.|_typing|dataclass", words)


def test_an_example_that_is_not_true_stops_the_step():
    doc = functions.described().members["judge"]
    doc.docstring = "Judge.\n\n>>> 1 + 1\n3\n"
    with pytest.raises(SystemExit, match="Expected:\n    3\nGot:\n    2"):
        functions.drawn(doc, functions.Path("figures/style.mplstyle"))
