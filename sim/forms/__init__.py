"""Solids out of a few numbers: lathe, extrusion, loft and tube; their mass; prints on them."""
