"""The maps that robots find themselves in: made by a walk through a world, kept by its form."""

from executive.runs.lidar_maps.choosing import localised
from executive.runs.lidar_maps.kept import key_of, needed

__all__ = ["key_of", "localised", "needed"]
