"""What a scene cannot say is refused, with the name of the part of the deck."""

from copy import deepcopy

import pytest
from changed_decks import (
    CURRENT,
    ENDS,
    FREEDOMS,
    SECTIONS,
    STAGES,
    changed,
    flexing,
    in_soil,
    later,
    rig,
    sea,
)

from riserstudy.errors import InputError
from riserstudy.importers.orcaflex import read_deck

#: 250e3, as decks have it
pytestmark = pytest.mark.filterwarnings("ignore::ruamel.yaml.error.MantissaNoDotYAML1_1Warning")


@pytest.mark.parametrize(
    "change, said",
    [
        (lambda d: d["General"].update(UnitsSystem="US"), "the setting US; write SI"),
        (lambda d: d["Lines"].append(deepcopy(d["Lines"][0])), "2 of them may be the riser"),
        (lambda d: d["Environment"].pop("Density"), "the import assumes no values"),
        (lambda d: d["LineTypes"][0].update(EIy=100.0), "EIy: 100.0"),
        (lambda d: d["LineTypes"][1].update(Category="Stress joint"), "Homogeneous pipe"),
        (lambda d: d["LineTypes"][0].pop("Cdx"), "Cdx or Cdn or Cd: missing; write the value"),
        (lambda d: d["LineTypes"][1].update(Cax=None), "Cax or Can or Ca: missing; write the value"),
        (lambda d: d["Lines"][0][SECTIONS][0].__setitem__(0, "Foam"), "no line type 'Foam'"),
        (lambda d: d["Lines"][0][ENDS][1].__setitem__(0, "Buoy"), "from 'Rig' to 'Buoy'"),
        (lambda d: d["Lines"][0][ENDS][0].__setitem__(5, 90), "declination of 90"),
        (lambda d: d["Environment"]["WaveTrains"][0].update(WaveType="Cnoidal", WavePeriod=4), "harmonic"),
        (lambda d: sea(d, WaveJONSWAPParameters="Automatic"), "Partially specified"),
        (lambda d: sea(d, WaveNumberOfSpectralDirections=7), "write 1, since"),
        (lambda d: sea(d, WaveTp=None), "WaveTp and WaveTz are missing"),
        (lambda d: d["Lines"][0].update(PyModel="Soft clay"), "no p-y model 'Soft clay'"),
        (lambda d: in_soil(d, DepthBelowSeabedFrom=3), "1 ranges of depth; give one range from 0 m"),
        (lambda d: in_soil(d) or d["P-yModels"][0]["PyCurves"].append({}), "2 ranges of depth"),
        (lambda d: in_soil(d, ModelType="API RP 2A sand"), "no curves of sand"),
        (lambda d: in_soil(d, ModelType="P-y table"), "no tables"),
        (lambda d: in_soil(d, Epsilonc=None), "Epsilonc: missing"),
        (lambda d: later(d) or d["LineTypes"][0].update(Cdx=1.1), "Cd: the value is given twice"),
        (lambda d: later(d) or d["LineTypes"][0].update(EI=[250e3, 200e3]), "the list 250000.0, 200000.0"),
        (lambda d: rig(d, links=1) or d["Links"][0].update(Stiffness=40.0), "give equal links"),
        (lambda d: rig(d) or d["Constraints"][0].update(TranslationalStiffness=5.0), "slides freely"),
        (lambda d: rig(d) or d["Constraints"][0][FREEDOMS][5].__setitem__(0, True), "z alone"),
        (lambda d: rig(d) or d["6DBuoys"][0].update(BuoyType="Spar buoy"), "Lumped buoy"),
        (lambda d: rig(d, winches=1) or d["Winches"][0][STAGES].append(["Payout rate", 0.1]), "all stages"),
        (lambda d: flexing(d) or d["Constraints"][0][FREEDOMS][0].__setitem__(0, True), "Rx and Ry"),
        (lambda d: d["Environment"].update(VerticalCurrentVariationMethod="Power law"), "Interpolated"),
        (lambda d: d["Environment"][CURRENT].append([1]), "CurrentFactor: None"),
        (lambda d: d["VesselTypes"][0].update(Symmetry="circular"), "xz plane"),
        (lambda d: d["Vessels"][0].update(InitialHeading=30), "bow along x"),
        (lambda d: d["Lines"][0].update(ContentsMethod="Slug flow"), "Uniform"),
    ],
)  # fmt: skip
def test_what_a_scene_cannot_say_is_refused(tmp_path, change, said):
    with pytest.raises(InputError, match="deck") as refused:
        read_deck(changed(tmp_path, change))
    assert said in str(refused.value)


def test_what_is_no_deck_is_refused(tmp_path):
    (tmp_path / "other.yml").write_text("a: 1\n")
    with pytest.raises(InputError, match="not an OrcaFlex model"):
        read_deck(tmp_path / "other.yml")
