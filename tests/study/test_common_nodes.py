"""Common nodes of runs on different meshes: as close as the finest mesh, and no closer."""

from itertools import pairwise

import numpy as np
import pytest

from riserstudy.study.common_nodes import common_nodes


def layered(draw, length, joint):
    """A mesh with finer layers at both ends of a riser, and a node where its lowest section ends."""
    ends = []
    for low, high in ((0.0, joint), (joint, length)):
        count = int(draw.integers(8, 60))
        even = np.linspace(0.0, 1.0, count + 1)
        bent = even - float(draw.uniform(0.0, 0.14)) * np.sin(2.0 * np.pi * even)
        ends.append(low + (high - low) * bent)
    return np.concatenate([ends[0], ends[1][1:]])


def spacing_at(mesh, places):
    """Length of the segment of a mesh around each place; infinite above its top."""
    upper = np.searchsorted(mesh, places)
    inside = upper < len(mesh)
    upper = np.minimum(upper, len(mesh) - 1)
    return np.where(inside, mesh[upper] - mesh[upper - 1], np.inf)


def random_meshes(seed):
    draw = np.random.default_rng(seed)
    joint = float(draw.uniform(20.0, 60.0))
    lengths = draw.uniform(300.0, 1500.0, int(draw.integers(1, 5)))
    return joint, [
        layered(draw, float(draw.choice(lengths)), joint) for _ in range(int(draw.integers(2, 12)))
    ]


@pytest.mark.parametrize("seed", range(40))
def test_common_nodes_are_as_close_as_the_finest_mesh_at_each_place(seed):
    _joint, meshes = random_meshes(seed)
    nodes = common_nodes(meshes)
    inside = np.linspace(1e-6, 1.0 - 1e-6, 400)
    for low, high in pairwise(nodes):
        places = low + (high - low) * inside
        finest = np.min([spacing_at(mesh, places) for mesh in meshes], axis=0)
        assert high - low <= finest.max() + 1e-5


@pytest.mark.parametrize("seed", range(40))
def test_common_nodes_are_few_and_contain_tops_and_ends_of_sections(seed):
    joint, meshes = random_meshes(seed)
    nodes = common_nodes(meshes)
    tops = {round(float(mesh[-1]), 6) for mesh in meshes}
    assert tops | {0.0, round(joint, 6)} <= set(nodes.tolist())
    assert (np.diff(nodes) > 0.0).all()
    # one segment for each of the finest mesh there, and at most one more below each node that is kept
    middle = np.sort(np.random.default_rng(seed).uniform(0.0, nodes[-1], 200_000))
    needed = float(np.mean(1.0 / np.min([spacing_at(mesh, middle) for mesh in meshes], axis=0))) * nodes[-1]
    assert len(nodes) - 1 <= 1.01 * needed + len(tops) + 2


@pytest.mark.parametrize("seed", range(20))
def test_a_mesh_that_is_finest_everywhere_is_used_itself(seed):
    draw = np.random.default_rng(seed)
    finest = layered(draw, 900.0, 40.0)
    coarser = [finest[:: int(2 ** draw.integers(1, 3))] for _ in range(3)]
    coarser = [np.unique(np.append(mesh, [40.0, 900.0])) for mesh in coarser]
    for order in ([finest, *coarser], [*coarser, finest]):
        assert np.allclose(common_nodes(order), finest, rtol=0.0, atol=2e-6)
        assert len(common_nodes(order)) == len(finest)


@pytest.mark.parametrize("seed", range(20))
def test_nodes_of_coarser_meshes_within_its_segments_change_nothing(seed):
    """Sums of shares of segments are whole numbers only but for rounding, which adds no segment."""
    draw = np.random.default_rng(seed)
    finest = layered(draw, 900.0, 40.0).round(6)
    most = int(900.0 / (1.1 * np.diff(finest).max()))
    coarser = [np.linspace(0.0, 900.0, int(draw.integers(1, most + 1)) + 1) for _ in range(4)]
    nodes = common_nodes([finest, *coarser])
    assert len(nodes) == len(finest)
    assert np.allclose(nodes, finest, rtol=0.0, atol=2e-6)


@pytest.mark.parametrize("seed", range(20))
def test_an_end_of_a_section_is_kept_if_all_risers_that_reach_it_have_it(seed):
    """Risers of the same lower sections, each with some of them, on meshes graded in different ways."""
    draw = np.random.default_rng(seed)
    ends = np.concatenate([[0.0], np.cumsum(draw.uniform(5.0, 80.0, 6)).round(3)])
    meshes = []
    for count in draw.integers(2, len(ends) + 1, 5):
        parts = [
            np.geomspace(*draw.uniform(1.0, 9.0, 2), int(draw.integers(2, 12))) for _ in range(count - 1)
        ]
        places = [(part - part[0]) / (part[-1] - part[0]) for part in parts]
        spans = zip(places, pairwise(ends[:count]), strict=True)
        meshes.append(np.concatenate([ends[:1], *(low + (high - low) * at[1:] for at, (low, high) in spans)]))
    highest = max(mesh[-1] for mesh in meshes)
    nodes = common_nodes(meshes)
    for end in ends[ends <= highest]:
        assert abs(nodes - end).min() < 1e-6
