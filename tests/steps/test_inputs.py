"""The check of config.yaml: what is wrong, where, and what was expected, all at once."""

import copy
import math
from pathlib import Path

import pytest

from replication.inputs.strict_yaml import read_yaml
from steps.inputs import check_inputs, horizontal, record_files, record_paths

ROOT = Path(__file__).resolve().parents[2]
CONFIG, QUICK, THOROUGH = (
    read_yaml(ROOT / "config" / name) for name in ("config.yaml", "quick.yaml", "thorough.yaml")
)


def faults(config):
    """The lines of the message, or none."""
    schema, records = ROOT / "config" / "config.schema.yaml", ROOT / "data" / "records"
    try:
        check_inputs(config, "config.yaml", str(schema), str(records))
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


def test_the_config_is_sound():
    assert faults(CONFIG) == []


def merged(base, over):
    """One config over another, as Snakemake merges them."""
    if not isinstance(over, dict):
        return over
    return base | {key: merged(base.get(key), value) for key, value in over.items()}


def differences(base, over, place=""):
    """Every entry of the config on top, and the entry that it replaces."""
    for key, value in over.items():
        here = f"{place}{key}"
        if isinstance(value, dict):
            yield from differences(base[key], value, f"{here}.")
        else:
            yield here, base[key], value


def test_quick_config_is_of_the_paper_alone():
    assert QUICK["studies"] == []


@pytest.mark.parametrize("other", [QUICK, THOROUGH], ids=["quick", "thorough"])
def test_other_config_is_sound_and_has_only_what_differs(other):
    assert faults(merged(CONFIG, other)) == []
    grids = {key: value for key, value in other.items() if key != "studies"}
    assert all(was != now for _, was, now in differences(CONFIG, grids))


@pytest.mark.parametrize("other", [QUICK, THOROUGH], ids=["quick", "thorough"])
def test_other_config_changes_how_densely_it_is_sampled_and_no_physics(other):
    sampling = {
        "points",
        "resolution",
        "floor",
        "cells",
        "checked_by_second_route",
        "frames_per_second",
    }
    places = [place for place, *_ in differences(CONFIG, other)]
    assert {place.rpartition(".")[2] for place in places} <= sampling | {"studies", "tightened"}


def test_thorough_config_is_finer_throughout():
    for place, was, now in differences(CONFIG, THOROUGH):
        is_finer_when_less = place.endswith(("resolution", "floor", "tightened"))
        assert (now < was) if is_finer_when_less else (now > was), place


@pytest.mark.parametrize(
    ("place", "value", "expected"),
    [
        (
            "trilith.mass_ration",
            1.0,
            "trilith has an unknown key 'mass_ration'; did you mean 'mass",
        ),
        ("trilth", {}, "the top level has an unknown key 'trilth'; did you mean 'trilith'?"),
        ("heavier.pulse.colour", 1, "heavier.pulse has an unknown key 'colour'; expected one of"),
        ("sketches.displaced.spam", 1.0, "sketches.displaced has an unknown key 'spam'; did you"),
        (
            "structures.Temple",
            {"half_width": 1.0, "half_height": 2.0},
            "structures has the name 'Temple'; expected a lower-case letter, then lower-case",
        ),
        (
            "spectra_dimensional.frames.trilith.1",
            {"cap_mass": 5.0},
            "spectra_dimensional.frames.trilith.1 lacks column_mass",
        ),
        ("mass_ratio.points", None, "mass_ratio lacks points"),
        ("mass_ratio", None, "the top level lacks mass_ratio"),
    ],
)
def test_keys_are_held_against_the_schema(place, value, expected):
    (fault,) = faults(changed(place, value))
    assert fault.startswith(f"config.yaml: {expected}")


@pytest.mark.parametrize(
    ("place", "value", "expected"),
    [
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
        ("solver.tightened", 0.5, "is 0.5; expected at most 0.001"),
        ("trilith.table_frequency", True, "is True; expected a value of type number"),
        (
            "studies.0",
            "1abc",
            "is '1abc'; expected a lower-case letter, then lower-case letters, digits or _",
        ),
        ("spectra_dimensional.frames.trilith.0", -0.2, "is -0.2; expected at least 0"),
        (
            "spectra_dimensional.frames.trilith.1",
            "heavy",
            "is 'heavy'; expected a number or a mapping of cap_mass and column_mass",
        ),
    ],
)
def test_a_value_out_of_range_is_told_with_place_and_expectation(place, value, expected):
    (fault,) = faults(changed(place, value))
    assert fault == f"config.yaml: {place} {expected}"


@pytest.mark.parametrize(
    "place",
    ["trilith.mass_ratio", "restitution.mass_ratios.2", "solver.tightened", "heavier.pulse.period"],
)
def test_what_is_not_a_number_is_refused(place):
    assert faults(changed(place, math.nan)) == [
        f"config.yaml: {place} is not a number (.nan); expected a number"
    ]


def test_massless_columns_are_allowed_where_they_make_sense():
    assert faults(changed("trilith_map.mass_ratio", math.inf)) == []
    (fault,) = faults(changed("moment_rotation.mass_ratios.3", math.inf))
    assert fault.startswith("config.yaml: moment_rotation.mass_ratios.3 is inf; expected at most")


@pytest.mark.parametrize(
    ("place", "value", "expected"),
    [
        ("heavier.structure", "tempel", "is 'tempel', not in structures; did you mean 'temple'?"),
        ("heavier.pulse.shape", "one-sin", "is 'one-sin'; did you mean 'one-sine'?"),
        ("heavier.pulse.shape", "harmonic", "is 'harmonic'; expected one of one-sine, one-cosine"),
        ("allen_errors.shape", "square", "is 'square'; expected one of one-sine, one-cosine"),
        ("allen_histories.record.file", "el_centro", "is 'el_centro', for which there is no "),
        ("allen_overturning.amplitudes.highest", 0.5, "is 0.5; expected more than "),
        ("allen_overturning.amplitudes.highest", 1.0, "is 1.0; expected more than "),
        ("heavier.mass_ratios", [0.0, 1.0, 1.0], "is [0.0, 1.0, 1.0]; expected numbers in asc"),
        ("heavier.mass_ratios", [0.0, 2.0, 1.0], "is [0.0, 2.0, 1.0]; expected numbers in asc"),
    ],
)
def test_what_does_not_fit_together_is_told(place, value, expected):
    (fault,) = faults(changed(place, value))
    assert fault.startswith(f"config.yaml: {place} {expected}")


def test_records_are_found_by_name_in_either_layout(tmp_path):
    for name in ("one.AT2", "two.csv", "three.at2", "README.md", "one.txt"):
        (tmp_path / name).touch()
    there = record_files(str(tmp_path))
    assert there == {Path(path).stem: path for path in there.values()}
    assert sorted(there) == ["one", "three", "two"]


@pytest.mark.parametrize("other", ["el_centro.csv", "el_centro.CSV", "el_centro.at2"])
def test_two_records_of_one_name_are_refused_naming_both(tmp_path, other):
    (tmp_path / "el_centro.AT2").touch()
    (tmp_path / other).touch()
    with pytest.raises(ValueError, match="both the record 'el_centro'") as error:
        record_files(str(tmp_path))
    assert f"{tmp_path}/el_centro.AT2" in str(error.value)
    assert f"{tmp_path}/{other}" in str(error.value)
    with pytest.raises(ValueError, match="both the record 'el_centro'"):
        check_inputs(CONFIG, "config.yaml", str(ROOT / "config/config.schema.yaml"), str(tmp_path))


MEASURED = sorted(
    path.stem
    for path in (ROOT / "data" / "records").glob("*.AT2")
    if "vertical" not in path.read_text(encoding="utf-8").splitlines()[0]
)
"""The records whose first line does not call them a vertical component."""


def test_name_of_a_record_says_whether_it_is_a_vertical_component():
    there = record_files(str(ROOT / "data" / "records"))
    assert horizontal(there) == MEASURED
    assert len(there) - len(MEASURED) == 3


def test_horizontal_means_every_horizontal_component():
    there = record_files(str(ROOT / "data" / "records"))
    assert record_paths("horizontal", there) == [there[name] for name in MEASURED]
    some = {"only": MEASURED[2:3], "because": "a test"}
    assert record_paths(some, there) == [there[MEASURED[2]]]


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (MEASURED[1:], "expected horizontal (every horizontal component in data/records) or a "),
        (MEASURED, "expected horizontal (every horizontal component in data/records) or a "),
        ("horizontl", "did you mean 'horizontal'?"),
        ({"only": MEASURED[1:]}, "vase.records lacks because"),
        ({"only": MEASURED[1:], "because": ""}, "vase.records.because is ''"),
        ({"because": "one will do for this"}, "vase.records lacks only"),
        ({"only": [], "because": "one will do for this"}, "vase.records.only is []"),
        (
            {"only": ["napa_2014_68150_UP"], "because": "one will do for this"},
            "vase.records.only.0 is 'napa_2014_68150_UP', a vertical component",
        ),
        ({"only": ["napa"], "because": "one will do for this"}, "vase.records.only.0 is 'napa'"),
        (
            {"only": MEASURED, "because": "one will do for this"},
            "vase.records.only names every horizontal component in ",
        ),
    ],
)
def test_no_section_leaves_out_a_record_without_a_reason(value, expected):
    (fault,) = faults(changed("vase.records", value))
    assert expected in fault


def test_some_records_are_accepted_with_the_reason():
    some = {"only": MEASURED[1:], "because": "one will do for this"}
    assert faults(changed("vase.records", some)) == []


@pytest.mark.parametrize("study", sorted(ROOT.glob("studies/*/config.schema.yaml")), ids=str)
def test_schemas_of_studies_define_records_alike(study):
    of_paper = read_yaml(ROOT / "config" / "config.schema.yaml")
    definitions = read_yaml(study).get("$defs", {})
    if "records" in definitions:
        expected = of_paper["$defs"]["records"]["oneOf"]
        assert definitions["records"]["oneOf"] == expected


def test_a_shape_without_a_closed_form_is_refused_where_one_is_needed():
    (fault,) = faults(changed("allen_histories.pulse.shape", "ricker-symmetric"))
    assert "allen_histories.pulse.shape is 'ricker-symmetric'" in fault


def test_columns_too_stocky_to_rock_under_a_cap_are_refused():
    (fault,) = faults(changed("structures.temple.half_width", 3.5))
    assert "structures.temple has the half width 3.5 and the half height 3.0, in m" in fault


def test_masses_of_a_frame_are_held_against_their_own_bounds():
    masses = {"cap_mass": -5.0, "column_mass": 0.0}
    place = "spectra_dimensional.frames.trilith.1"
    assert faults(changed(place, masses)) == [
        f"config.yaml: {place}.cap_mass is -5.0; expected at least 0",
        f"config.yaml: {place}.column_mass is 0.0; expected more than 0",
    ]


@pytest.mark.parametrize("config", [[], "text", 1.0])
def test_config_that_is_no_mapping_is_refused(config):
    assert faults(config) == [
        f"config.yaml: the top level is {config!r}; expected a value of type object"
    ]


def test_all_faults_come_in_one_message():
    config = changed("trilith.mass_ratio", -0.2)
    config["heavier"]["structure"] = "tower"
    config["solver"]["tolerances"] = 1e-9
    config["mass_ratio"]["largest"] = math.nan
    assert len(faults(config)) == 4
