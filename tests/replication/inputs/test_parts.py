"""The parts of a work, and the texts that they write."""

import pickle

import pytest

from replication.inputs.configuration import Sections


def test_section_that_a_rule_takes_and_the_config_lacks_is_named_with_its_file():
    config = Sections({"period": {}, "mass": {}})
    said = "config/config.yaml has no section 'periods', .*; did you mean 'period'"
    with pytest.raises(ValueError, match=said):
        config["periods"]
    assert type(pickle.loads(pickle.dumps(config))) is dict  # a job loads no module for it
