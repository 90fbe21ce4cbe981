"""What the hands carry, in the model of the body that the controller computes with."""

from __future__ import annotations

import mujoco

from robot.messages import Side
from robot.model.body import BodyModel
from robot.se3 import Array


class Payloads:
    """Keeps masses and centres of mass of the hands, and the body's whole mass, in step."""

    def __init__(self, body: BodyModel) -> None:
        """Begin with empty hands; `body`'s model is changed from here."""
        self._body = body
        self._mass: Array = body.model.body_mass.copy()  # of the bare body
        self._ipos: Array = body.model.body_ipos.copy()
        self._carried_kg: dict[Side, float] = {}

    def carry(self, side: Side, mass_kg: float) -> None:
        """Put a payload at the grasp point of a hand, instead of what was there (0 kg: nothing)."""
        self._carried_kg[side] = mass_kg
        body, model = self._body, self._body.model
        model.body_mass[:] = self._mass
        model.body_ipos[:] = self._ipos
        for one, mass in self._carried_kg.items():
            site = body.grasp_site[one]
            hand = int(model.site_bodyid[site])
            own = float(self._mass[hand])
            total = own + mass
            grasp = model.site_pos[site]
            model.body_ipos[hand] = (own * self._ipos[hand] + mass * grasp) / total
            model.body_mass[hand] = total
        mujoco.mj_setConst(model, body.data())
        body.mass_kg = float(model.body_subtreemass[body.base_body])

    def drop(self) -> None:
        """Take everything out of the hands."""
        for side in tuple(self._carried_kg):
            self.carry(side, 0.0)
