"""The check of config.yaml: what is wrong, where, and what was expected, all at once."""

import copy
import math
from pathlib import Path

import pytest

from replication.inputs.strict_yaml import read_yaml
from steps.inputs import check_inputs, horizontal, record_files, record_paths

ROOT = Path(__file__).resolve().parents[2]
RECORDS, SCHEMA = str(ROOT / "data" / "records"), str(ROOT / "config" / "config.schema.yaml")
CONFIG, QUICK, THOROUGH = (
    read_yaml(ROOT / "config" / name) for name in ("config.yaml", "quick.yaml", "thorough.yaml")
)
MEASURED = sorted(  # whose first line does not call them a vertical component
    path.stem
    for path in (ROOT / "data" / "records").glob("*.AT2")
    if "vertical" not in path.read_text(encoding="utf-8").splitlines()[0]
)
SAMPLING = {"points", "resolution", "floor", "cells", "checked_by_second_route"}
SAMPLING |= {"frames_per_second", "tightened", "studies"}


def faults(config):
    """The lines of the message, or none."""
    try:
        check_inputs(config, "config.yaml", SCHEMA, RECORDS)
    except ValueError as error:
        return str(error).splitlines()
    return []


def changed(place, value):
    """The config with another value at a dotted place; None takes the entry away."""
    config = copy.deepcopy(CONFIG)
    *path, last = (int(part) if part.isdigit() else part for part in place.split("."))
    entry = config
    for key in path:
        entry = entry[key]
    if value is None:
        del entry[last]
    else:
        entry[last] = value
    return config


def merged(base, over):
    """One config over another, as Snakemake merges them."""
    if not isinstance(over, dict):
        return over
    return base | {key: merged(base.get(key), value) for key, value in over.items()}


def differences(base, over, place=""):
    """Every entry of the config on top, and the entry that it replaces."""
    for key, value in over.items():
        if isinstance(value, dict):
            yield from differences(base[key], value, f"{place}{key}.")
        else:
            yield f"{place}{key}", base[key], value


@pytest.mark.parametrize("other", [{}, QUICK, THOROUGH], ids=["usual", "quick", "thorough"])
def test_config_is_sound_and_changes_how_densely_it_is_sampled_and_no_physics(other):
    assert faults(merged(CONFIG, other)) == []
    for place, was, now in differences(CONFIG, other):
        *_, name = place.split(".")
        assert name in SAMPLING
        assert place == "studies" or was != now, place
        if other is THOROUGH:  # is finer throughout
            less = name in ("resolution", "floor", "tightened")
            assert (now < was) if less else (now > was), place
    assert QUICK["studies"] == []


PLACE = "spectra_dimensional.frames.trilith.1"
SOME = {"because": "one will do for this"}
NOT_ALL = "expected horizontal (every horizontal component in data/records) or a "
NAME = "a lower-case letter, then lower-case"
WRONG = [  # place, value, what is said of it; without a place in front, of what holds it
    ("trilith.mass_ration", 1.0, "=trilith has an unknown key 'mass_ration'; did you mean 'mass"),
    ("trilth", {}, "=the top level has an unknown key 'trilth'; did you mean 'trilith'?"),
    ("heavier.pulse.colour", 1, "=heavier.pulse has an unknown key 'colour'; expected one of"),
    ("sketches.displaced.spam", 1.0, "=sketches.displaced has an unknown key 'spam'; did you"),
    (
        "structures.Temple",
        CONFIG["structures"]["temple"],
        f"=structures has the name 'Temple'; expected {NAME}",
    ),
    (PLACE, {"cap_mass": 5.0}, f"={PLACE} lacks column_mass"),
    ("mass_ratio.points", None, "=mass_ratio lacks points"),
    ("mass_ratio", None, "=the top level lacks mass_ratio"),
    ("trilith.mass_ratio", -0.2, "is -0.2; expected at least 0"),
    ("structures.temple.half_width", 0.0, "is 0.0; expected more than 0"),
    ("structures.temple.half_height", -3.0, "is -3.0; expected more than 0"),
    ("allen_overturning.slenderness", 45.0, "is 45.0; expected less than 45"),
    ("restitution.largest_slenderness", 90.0, "is 90.0; expected less than 90"),
    ("restitution.slendernesses.0", 0.0, "is 0.0; expected more than 0"),
    ("allen_errors.slendernesses.highest", 50.0, "is 50.0; expected less than 45"),
    ("mass_ratio.points", 1, "is 1; expected at least 2"),
    ("mass_ratio.points", 20.5, "is 20.5; expected a value of type integer"),
    ("mass_ratio.largest", "ten", "is 'ten'; expected a value of type number"),
    ("mass_ratio.largest", math.inf, "is inf; expected at most 1000000.0"),
    ("moment_rotation.mass_ratios.3", math.inf, "is inf; expected at most"),
    ("solver.tightened", 0.5, "is 0.5; expected at most 0.001"),
    ("trilith.table_frequency", True, "is True; expected a value of type number"),
    ("studies.0", "1abc", f"is '1abc'; expected {NAME} letters, digits or _"),
    ("spectra_dimensional.frames.trilith.0", -0.2, "is -0.2; expected at least 0"),
    (PLACE, "heavy", "is 'heavy'; expected a number or a mapping of cap_mass and column_mass"),
    *(
        (place, math.nan, "is not a number (.nan); expected a number")
        for place in (
            *("trilith.mass_ratio", "restitution.mass_ratios.2"),
            *("solver.tightened", "heavier.pulse.period"),
        )
    ),
    ("heavier.structure", "tempel", "is 'tempel', not in structures; did you mean 'temple'?"),
    ("heavier.pulse.shape", "one-sin", "is 'one-sin'; did you mean 'one-sine'?"),
    ("heavier.pulse.shape", "harmonic", "is 'harmonic'; expected one of one-sine, one-cosine"),
    ("allen_errors.shape", "square", "is 'square'; expected one of one-sine, one-cosine"),
    ("allen_histories.record.file", "el_centro", "is 'el_centro', for which there is no "),
    ("allen_histories.pulse.shape", "ricker-symmetric", "is 'ricker-symmetric'"),  # no closed form
    ("allen_overturning.amplitudes.highest", 0.5, "is 0.5; expected more than "),
    ("allen_overturning.amplitudes.highest", 1.0, "is 1.0; expected more than "),
    ("heavier.mass_ratios", [0.0, 1.0, 1.0], "is [0.0, 1.0, 1.0]; expected numbers in asc"),
    ("heavier.mass_ratios", [0.0, 2.0, 1.0], "is [0.0, 2.0, 1.0]; expected numbers in asc"),
    (
        "structures.temple.half_width",
        3.5,
        "=structures.temple has the half width 3.5 and the half height 3.0, in m",
    ),
    ("vase.records", MEASURED[1:], f"is {MEASURED[1:]}; {NOT_ALL}"),
    ("vase.records", MEASURED, f"is {MEASURED}; {NOT_ALL}"),
    ("vase.records", "horizontl", "is 'horizontl'; did you mean 'horizontal'?"),
    ("vase.records", {"only": MEASURED[1:]}, "lacks because"),
    ("vase.records", {"only": MEASURED[1:], "because": ""}, "=vase.records.because is ''"),
    ("vase.records", SOME, "lacks only"),
    ("vase.records", {"only": []} | SOME, "=vase.records.only is []"),
    (
        *("vase.records", {"only": ["napa_2014_68150_UP"]} | SOME),
        "=vase.records.only.0 is 'napa_2014_68150_UP', a vertical component",
    ),
    ("vase.records", {"only": ["napa"]} | SOME, "=vase.records.only.0 is 'napa'"),
    ("vase.records", {"only": MEASURED} | SOME, "=vase.records.only names every horizontal comp"),
]


@pytest.mark.parametrize(("place", "value", "says"), WRONG)
def test_what_is_wrong_is_told_with_its_place_and_what_was_expected(place, value, says):
    (fault,) = faults(changed(place, value))
    expected = says[1:] if says.startswith("=") else f"{place} {says}"
    assert fault.startswith(f"config.yaml: {expected}")


def test_records_are_found_by_name_in_either_layout(tmp_path):
    for name in ("one.AT2", "two.csv", "three.at2", "README.md", "one.txt"):
        (tmp_path / name).touch()
    there = record_files(str(tmp_path))
    assert there == {Path(path).stem: path for path in there.values()}
    assert sorted(there) == ["one", "three", "two"]
    for other in ("one.csv", "one.CSV", "one.at2"):
        (tmp_path / other).touch()
        both = rf"(?=.*/one\.AT2 )(?=.*/{other} ).*both the record 'one'"
        with pytest.raises(ValueError, match=both):
            record_files(str(tmp_path))
        with pytest.raises(ValueError, match="both the record 'one'"):
            check_inputs(CONFIG, "config.yaml", SCHEMA, str(tmp_path))
        (tmp_path / other).unlink()


def test_horizontal_means_every_horizontal_component():
    """The name of a record says whether it is a vertical one."""
    there = record_files(RECORDS)
    assert horizontal(there) == MEASURED
    assert len(there) - len(MEASURED) == 3
    assert record_paths("horizontal", there) == [there[name] for name in MEASURED]
    some = {"only": MEASURED[2:3], "because": "a test"}
    assert record_paths(some, there) == [there[MEASURED[2]]]


def test_several_faults_come_in_one_message():
    masses = {"cap_mass": -5.0, "column_mass": 0.0}
    assert faults(changed(PLACE, masses)) == [
        f"config.yaml: {PLACE}.cap_mass is -5.0; expected at least 0",
        f"config.yaml: {PLACE}.column_mass is 0.0; expected more than 0",
    ]
    config = changed("trilith.mass_ratio", -0.2)
    config["heavier"]["structure"] = "tower"
    config["solver"]["tolerances"] = 1e-9
    config["mass_ratio"]["largest"] = math.nan
    assert len(faults(config)) == 4
    for config in ([], "text", 1.0):
        assert faults(config) == [
            f"config.yaml: the top level is {config!r}; expected a value of type object"
        ]
