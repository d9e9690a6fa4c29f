"""The lines of studies/FOLLOW-UP.md do what they say."""

import re
from pathlib import Path

import yaml

from topheavy import read_record

ROOT = Path(__file__).parents[1]
GUIDE = (ROOT / "studies/FOLLOW-UP.md").read_text(encoding="utf-8")


def test_step_of_the_guide_computes_what_its_claim_states():
    (step,) = re.findall(r"```python\n(.*?)```", GUIDE, re.DOTALL)
    rows = [yaml.safe_load(block) for block in re.findall(r"```yaml\n(- id.*?)```", GUIDE, re.S)]
    ((claim,),) = rows
    names = {"__name__": "step"}
    exec(compile(step, "studies/FOLLOW-UP.md", "exec"), names)
    found = names["main"](read_record(ROOT / "data/records/el_centro_1940_NS.AT2"))
    assert found[claim["finding"]].holds  # "survives the record as it was measured"
    assert "as it was measured" in claim["statement"]
    assert ".scaled(" not in step
