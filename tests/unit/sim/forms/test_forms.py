"""Solids are closed, have the volume and inertia of geometry books, and know their pictures."""

import math

import numpy as np
import pytest

from sim.forms.lathe import band, lathe
from sim.forms.loft import loft, prism, rounded, triangles, tube, wrapped
from sim.forms.mesh import Mesh, joined

CYLINDER = lathe([(0, 0), (0.04, 0), (0.04, 0.1), (0, 0.1)], segments=96)
SQUARE = [(0.0, 0.0), (0.1, 0.0), (0.1, 0.1), (0.0, 0.1)]
BAY = [(0.0, 0.0), (0.1, 0.0), (0.1, 0.1), (0.05, 0.03), (0.0, 0.1)]
SOLIDS = {
    "cylinder": (CYLINDER, math.pi * 0.04**2 * 0.1),
    "cone": (lathe([(0, 0), (0.03, 0), (0, 0.09)], segments=96), math.pi * 0.03**2 * 0.03),
    "cup": (
        lathe([(0, 0), (0.04, 0), (0.04, 0.1), (0.03, 0.1), (0.03, 0.01), (0, 0.01)], segments=96),
        math.pi * (0.04**2 * 0.1 - 0.03**2 * 0.09),
    ),
    "ring": (
        lathe([(0.03, 0), (0.04, 0), (0.04, 0.02), (0.03, 0.02), (0.03, 0)], segments=96),
        math.pi * (0.04**2 - 0.03**2) * 0.02,
    ),
    "rod": (tube([(0, 0, 0), (0, 0, 0.3)], (0.01, 0.01), corners=96), math.pi * 0.01**2 * 0.3),
    "box": (prism(SQUARE, 0.0, 0.1), 0.001),
    "pyramid": (prism(SQUARE, 0.0, 0.3, narrowed=1e-6), 0.001),
    "with a bay": (prism(BAY, 0.0, 0.1), 0.00065),
    "printed": (wrapped(rounded(0.06, 0.1, 0.0), 0.0, 0.2), 0.0012),
}


@pytest.mark.parametrize("name", SOLIDS)
def test_a_solid_is_closed_and_as_large_as_it_should_be(name):
    mesh, volume = SOLIDS[name]
    assert mesh.is_watertight()
    assert mesh.volume_m3 == pytest.approx(volume, rel=2e-3)


def test_a_hole_is_noticed():
    mesh = SOLIDS["box"][0]
    assert not Mesh(mesh.points, mesh.faces[1:]).is_watertight()
    assert not Mesh(mesh.points, np.concatenate([mesh.faces, mesh.faces[:1]])).is_watertight()


def test_inertia_is_that_of_a_cylinder():
    """About its middle, wherever it is: m (3 r² + h²) / 12, and m r² / 2 about its axis."""
    matter = CYLINDER.moved((0.3, -0.2, 0.1)).matter(1000.0)
    r, h, m = 0.04, 0.1, matter.mass_kg
    assert matter.middle == pytest.approx([0.3, -0.2, 0.15])
    across = m * (3 * r * r + h * h) / 12
    wanted = np.diag([across, across, m * r * r / 2])
    assert matter.inertia == pytest.approx(wanted, rel=2e-3, abs=1e-9)


def test_what_is_hollow_is_taken_away():
    inner = lathe([(0, 0), (0.03, 0), (0.03, 0.1), (0, 0.1)], segments=96)
    tube_ = CYLINDER.matter(1.0).with_(inner.matter(1.0).times(-1.0))
    ring = lathe([(0.03, 0), (0.04, 0), (0.04, 0.1), (0.03, 0.1), (0.03, 0)], segments=96).matter(
        1.0
    )
    assert tube_.mass_kg == pytest.approx(ring.mass_kg)
    assert tube_.inertia == pytest.approx(ring.inertia, rel=1e-9)


def test_a_tube_goes_around_corners_without_a_twist():
    t = np.linspace(0.0, math.pi, 60)
    way = np.column_stack([0.05 * np.cos(t), np.zeros(60), 0.05 * np.sin(t)])
    mesh = tube(way, [0.005] * 60, corners=48)
    assert mesh.is_watertight()
    assert mesh.volume_m3 == pytest.approx(math.pi * 0.005**2 * math.pi * 0.05, rel=1e-2)


def test_a_picture_goes_around_once_from_the_top_down():
    mesh = band([(0.03, 0.0), (0.03, 0.1)], low_m=0.02, high_m=0.08, thick_m=0.001)
    assert mesh.is_watertight()
    assert mesh.wrap is not None
    assert len(mesh.wrap.faces) == len(mesh.faces)
    for face, places in zip(mesh.faces, mesh.wrap.faces, strict=True):
        for p, (u, v) in zip(mesh.points[face], mesh.wrap.uv[places], strict=True):
            assert v == pytest.approx((0.08 - p[2]) / 0.06, abs=1e-9)
            angle = math.atan2(p[1], p[0]) / math.tau % 1.0
            assert abs((u - angle + 0.5) % 1.0 - 0.5) < 1e-9


def test_edges_stay_edges_and_round_sides_round():
    """A cylinder's rims are doubled: its two lids, and its side."""
    sharp = CYLINDER.creased()
    assert len(sharp.points) == len(CYLINDER.points) + 2 * 96
    assert sharp.volume_m3 == pytest.approx(CYLINDER.volume_m3)
    assert len(SOLIDS["box"][0].creased().points) == 24


def test_triangles_fill_an_outline_with_a_bay():
    outline = np.array(BAY)
    a, b, c = outline[triangles(outline)].transpose(1, 0, 2)
    areas = 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    assert np.all(areas > 0.0)
    assert areas.sum() == pytest.approx(0.0065)


def test_lofts_are_joined_without_a_change():
    ring = np.array([(0.0, y, z) for y, z in SQUARE])
    one = loft([ring, ring + np.array([0.2, 0.0, 0.0])])
    both = joined([one, one.moved((1.0, 0.0, 0.0))])
    assert one.volume_m3 == pytest.approx(0.002)
    assert both.volume_m3 == pytest.approx(0.004)
    assert both.is_watertight()
