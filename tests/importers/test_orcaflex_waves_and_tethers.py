"""Waves that begin with the build-up, seas with two periods, and tethers, which do not push."""

import numpy as np
import pytest
from changed_decks import loaded, pulled, sea

from riserstudy.importers.orcaflex.sea import peak_over_zero_crossing


def imported_text(capsys, tmp_path, change):
    loaded(tmp_path, change)
    return "".join(capsys.readouterr())


@pytest.mark.parametrize("seed", range(4))
def test_a_tether_is_its_spring_while_taut_and_pulls_nothing_while_slack(tmp_path, seed):
    draw = np.random.default_rng(seed)
    unstretched = float(draw.uniform(3.0, 15.0))

    def tethers(deck):
        pulled(deck)
        for link in deck["Links"]:
            link |= {"LinkType": "Tether", "UnstretchedLength": unstretched, "Stiffness": 50.0 * unstretched}

    def springs(deck):
        pulled(deck)
        for link in deck["Links"]:
            link["UnstretchedLength"] = unstretched

    tether = loaded(tmp_path, tethers).top.tensioners
    spring = loaded(tmp_path, springs).top.tensioners.linear
    reach, force = (np.array([getattr(row, name) for row in tether.table]) for name in ("reach", "force"))
    at = np.linspace(reach[0], reach[-1], 200)
    line = spring.tension + spring.stiffness * at
    assert np.allclose(np.interp(at, reach, force), np.maximum(line, 0.0), atol=1.0, rtol=1e-5)
    assert (line < 0.0).any()


@pytest.mark.parametrize("seed", range(4))
def test_a_wave_that_begins_with_the_build_up_is_named_unless_this_is_whole_periods(tmp_path, capsys, seed):
    draw = np.random.default_rng(seed)
    period = float(draw.integers(6, 15))
    build_up = period * float(draw.integers(1, 3)) + (0.25 * period if seed % 2 else 0.0)

    def change(deck):
        deck["Environment"]["WaveTrains"][0]["WavePeriod"] = period
        deck["General"]["StageDuration"][0] = build_up

    text = imported_text(capsys, tmp_path, change)
    assert ("90° earlier than in the deck" in " ".join(text.split())) == bool(seed % 2)


@pytest.mark.parametrize("seed", range(4))
def test_two_periods_of_one_sea_must_be_those_of_one_spectrum(tmp_path, capsys, seed):
    draw = np.random.default_rng(seed)
    peak, gamma = float(draw.uniform(6.0, 15.0)), float(draw.uniform(1.0, 5.0))
    crossing = peak / peak_over_zero_crossing(gamma)

    def both(factor):
        return lambda deck: sea(deck, WaveTp=peak, WaveTz=round(factor * crossing, 2), WaveGamma=gamma)

    assert loaded(tmp_path, both(1.0)).wave.peak_period == pytest.approx(peak)
    with pytest.raises(SystemExit):
        loaded(tmp_path, both(float(draw.choice([0.95, 1.05]))))
    assert "WaveTz" in "".join(capsys.readouterr())
