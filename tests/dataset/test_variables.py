"""Names, units and labels that datasets carry."""

import pytest

from riserstudy.dataset.variables import variables

ATTRIBUTES = {"units", "long_name", "standard_name", "label", "comment", "positive"}


@pytest.mark.parametrize("name", sorted(variables()))
def test_every_attribute_is_a_text_that_a_file_can_hold(name):
    """A comma in a text without quotes begins another attribute, without a value."""
    about = variables()[name]
    assert all(isinstance(value, str) and value for value in about.values())
    assert about["long_name"].strip() == about["long_name"]
    assert about.keys() <= ATTRIBUTES
