"""Scene files as they are: those of the repository, origins, overrides, the JSON schema."""

import json
from pathlib import Path

import pytest

from riserstudy import load_scene
from riserstudy.errors import InputError
from riserstudy.scene.load import read_scene
from riserstudy.scene.models import Scene

SCENES = Path(__file__).parents[2] / "config" / "scenes"
ALL = sorted(SCENES.glob("**/*.yaml"))
CHANG = SCENES / "chang2020" / "heave.yaml"
SURGE = SCENES / "bench" / "s2.yaml"


def test_the_benchmark_scenes_are_there():
    names = ["api2j", "s1", "s2", "s2c", "s3", "s4a", "s4b", "s4c", "s4d", "s4e", "vortices"]
    assert [path.stem for path in sorted((SCENES / "bench").glob("*.yaml"))] == names


@pytest.mark.parametrize("path", ALL, ids=lambda p: f"{p.parent.name}/{p.stem}")
def test_every_scene_of_the_repository_is_valid(path):
    assert load_scene(path).resolved().title


@pytest.mark.parametrize("path", ALL, ids=lambda p: f"{p.parent.name}/{p.stem}")
def test_every_option_and_range_of_an_assumption_is_valid_too(path):
    file = read_scene(path)
    for place, origin in file.origins.items():
        for value in [*origin.options, *(origin.range or ())]:
            file.with_values({place: value}, "assumption").resolved()


def test_origins_say_what_is_assumed_derived_and_calibrated():
    origins = load_scene(CHANG).origins
    pressure = origins["top.tensioners.gas.pressure"]
    assert pressure.status == "assumed"
    assert pressure.options == ("190.2 bar absolute", "190.2 bar gauge")
    assert "bar without stating absolute or gauge" in pressure.why
    assert origins["riser[0].axial_stiffness"].status == "derived"
    assert origins["platform.heave.phase"].range == ("0 deg", "360 deg")
    assert "top.tensioners.gas.volume" not in origins  # plain, so published
    tuned = load_scene(CHANG, **{"top.body.mass": {"calibrated": "700 t", "to": "chang2020/N1"}})
    assert tuned.origins["top.body.mass"].status == "calibrated"
    assert tuned.origins["top.body.mass"].why == "chang2020/N1"
    assert tuned.resolved().top.body.mass == pytest.approx(700e3)


def test_an_override_takes_the_value_and_forgets_its_origin():
    file = load_scene(CHANG, **{"top.tensioners.gas.pressure": "2 bar gauge"})
    assert "top.tensioners.gas.pressure" not in file.origins
    assert file.resolved().top.tensioners.gas.pressure == pytest.approx(301325.0)
    assert load_scene(CHANG).resolved().top.tensioners.gas.pressure == pytest.approx(190.2e5)


def test_an_override_reaches_into_lists_makes_sections_and_takes_them_away():
    file = load_scene(
        SURGE,
        **{
            "riser[0].mass": "2 t/m",
            "platform.cruise.speed": "1 m/s",
            "platform.cruise.ramp": "9 s",
            "platform.surge": None,
        },
    )
    scene = file.resolved()
    assert scene.riser[0].mass == 2000.0
    assert scene.platform.cruise.ramp == 9.0
    assert scene.platform.surge is None


def test_an_error_names_the_layer_that_set_the_path():
    with pytest.raises(InputError, match="overrides"):
        load_scene(SURGE, **{"riser[7].mass": "1 t/m"})


def test_the_json_schema_forbids_unknown_keys_everywhere():
    schema = Scene.model_json_schema()
    models = [schema, *schema["$defs"].values()]
    assert all(m.get("additionalProperties") is False for m in models if m.get("type") == "object")
    json.dumps(schema)


def test_nothing_that_shapes_physics_has_a_default_value():
    """Absent is None, always: a default would be an effect that nobody asked for."""

    def defaults(model):
        for name, field in model.model_fields.items():
            if not field.is_required():
                yield f"{model.__name__}.{name}", field.default

    def below(model, seen):
        if model in seen:
            return
        seen.add(model)
        for field in model.model_fields.values():
            for kind in nested(field.annotation):
                below(kind, seen)

    def nested(annotation):
        if isinstance(annotation, type):
            if hasattr(annotation, "model_fields"):
                yield annotation
            return
        for part in getattr(annotation, "__args__", ()):
            yield from nested(part)

    seen = set()
    below(Scene, seen)
    assert len(seen) > 20
    assert {name: value for m in seen for name, value in defaults(m) if value is not None} == {}


@pytest.mark.parametrize("name", ["current.txt", 5, "current", "C:\\current.csv"])
def test_a_table_that_is_no_csv_file_is_named_with_scene_and_field(tmp_path, name):
    """Before, the message named the folder instead of the scene, and no field."""
    tree = json.loads(json.dumps(read_scene(SCENES / "bench/s2.yaml").tree))
    tree["water"] = {"density": "1025 kg/m^3", "surface": "533 m", "seabed": "0 m"}
    tree["current"] = {"profile": {"file": name}}
    (tmp_path / "scene.yaml").write_text(json.dumps(tree))
    with pytest.raises(InputError) as error:
        load_scene(tmp_path / "scene.yaml")
    assert (error.value.where, error.value.field) == (str(tmp_path / "scene.yaml"), "current.profile.file")
