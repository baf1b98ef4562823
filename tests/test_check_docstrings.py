"""The check of docstrings finds what is missing, and asks for nothing that is there."""

from textwrap import dedent

import pytest

import check_docstrings


@pytest.fixture
def faults(tmp_path, monkeypatch):
    """Faults of one file of a package, by their words."""

    def of(folder, text):
        path = tmp_path / "src/riserstudy" / folder / "part.py"
        path.parent.mkdir(parents=True)
        path.write_text(dedent(text), encoding="utf-8")
        monkeypatch.setattr(check_docstrings, "ROOT", tmp_path)
        monkeypatch.setattr(check_docstrings, "PACKAGE", tmp_path / "src/riserstudy")
        kinds = {"InputError": {"InputError", "RiserStudyError"}}
        return [fault.partition(": ")[2] for fault in check_docstrings.faults_of(path, kinds)]

    return of


def function(said, signature="(length: FloatArray) -> float", body="return 0.0"):
    return f'def area{signature}:\n    """{said}"""\n    {body}\n'


@pytest.mark.long
def test_the_package_passes():
    kinds = check_docstrings.errors()
    paths = sorted(check_docstrings.PACKAGE.rglob("*.py"))
    assert len(paths) > 200
    assert [fault for path in paths for fault in check_docstrings.faults_of(path, kinds)] == []


@pytest.mark.parametrize(
    "said, missing",
    [
        ("Of a strip.", ["area: no unit of its numbers", "area: no shape of its arrays"]),
        ("Of a strip (m2).", ["area: no shape of its arrays"]),
        ("Of a strip, (n,).", ["area: no unit of its numbers"]),
        # what looks like a unit or a shape and is none
        ("Of a strip, (N, m), as f(t).", ["area: no unit of its numbers"]),
        ("Of a strip (m, unstretched), 0 or 1.", ["area: no shape of its arrays"]),
        ("Of a strip, (n,), N/(m rad).", []),
        ("Share of the whole, of any shape.", []),
    ],
)
def test_units_and_shapes_are_asked_for(faults, said, missing):
    assert faults("model", function(said)) == missing


def test_what_takes_datasets_needs_neither(faults):
    assert faults("grading", function("Of a strip.")) == []


def test_private_functions_need_neither(faults):
    assert faults("model", function("Of a strip.").replace("area", "_area")) == []


RAISING = """
def area(name: str) -> str:
    '''Of a strip.{said}'''
    return _checked(name)

def _checked(name: str) -> str:
    raise errors.InputError("file", name, "nothing", "a name")
"""


def test_an_error_of_a_private_function_is_asked_for(faults):
    assert faults("report", RAISING.format(said="")) == ["area: no sentence 'Raises InputError'"]


@pytest.mark.parametrize("error", ["InputError", "RiserStudyError"])
def test_an_error_is_told_by_its_name_or_its_kind(faults, error):
    section = f"\n\n    Raises\n    ------\n    {error}\n        Always.\n    "
    assert faults("report", RAISING.format(said=section)) == []


@pytest.mark.parametrize("error, told", [("InputError", True), ("SimulationError", False)])
def test_an_error_is_told_in_a_sentence(faults, error, told):
    said = f" Raises\n    {error} always."
    assert bool(faults("report", RAISING.format(said=said))) is not told


RECORD = """
class Spring(NamedTuple):
    '''A spring.'''

    stiffness: float  # {stiffness}
    # {node}
    node: np.ndarray
    count: int
"""


def test_fields_of_a_record_need_unit_or_shape(faults):
    text = RECORD.format(stiffness="by length", node="where it is")
    assert faults("effects", text) == ["Spring.stiffness: no unit", "Spring.node: no shape"]


def test_a_comment_beside_or_above_a_field_serves(faults):
    assert faults("effects", RECORD.format(stiffness="(N/m)", node="(k,) where it is")) == []


EFFECT = '"""A spring.{said}"""\n\nregister(Spring, device=force)\n'


def test_an_effect_needs_its_source(faults):
    assert faults("effects", EFFECT.format(said="")) == [
        "no References, which tell where the effect's equation is from"
    ]


def test_an_effect_with_its_source_passes(faults):
    said = "\n\nReferences\n----------\nElementary: Hooke's law.\n"
    assert faults("effects", EFFECT.format(said=said)) == []
