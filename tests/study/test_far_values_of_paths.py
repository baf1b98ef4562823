"""Numbers that are set at several paths are compared with the scene's value at each of them."""

import numpy as np
import pytest
import short_study

from riserstudy.study.far_values import far_values

STUDY = """\
paper: far
studies:
  diameters:
    scene: scenes/riser.yaml
    caption: one number at several paths
    set: {{"{changed}": "{value!r} mm"}}
    axes:
      diameter: {{path: {paths}, unit: mm, values: {numbers}}}
"""
OWN = {
    "riser[0].outer_diameter": 533.4,
    "riser[0].drag.diameter": 600.0,
    "riser[0].added_mass.diameter": 600.0,
}


@pytest.mark.parametrize("seed", range(8))
def test_a_path_whose_value_is_far_is_named_and_no_other(seed, tmp_path):
    draw = np.random.default_rng(seed)
    paths = draw.permutation([*OWN]).tolist()[: int(draw.integers(2, 4))]
    changed = str(draw.choice(paths))
    numbers = sorted((400.0 * draw.uniform(0.5, 1.3, 3)).round(1).tolist())
    for factor in (1.1, 5000.0, 1.0 / 5000.0):
        value = round(OWN[changed] * factor, 5)
        folder = tmp_path / f"{factor:g}"
        folder.mkdir()
        text = STUDY.format(changed=changed, value=value, paths=paths, numbers=numbers)
        warned = far_values(short_study.studies_in(folder, "far", text)("diameters"))
        if factor == 1.1:
            assert warned == []
            continue
        (line,) = warned
        far = max(numbers) if factor < 1.0 else min(numbers)
        assert f"axes.diameter: {far} mm is " in line
        assert f" at {changed};" in line
