"""What colours a thing has, in words, from its pixels."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

GREY, DARK = 0.22, 0.16
"""Saturation below which a pixel has no colour; value below which none can be told."""
BLACK, WHITE = 0.25, 0.60
"""Values of what has no colour: up to, from."""
PALE = 0.60
"""Saturation below which red is pink, and orange brown."""
DEEP = 0.50
"""Value below which orange is brown."""
HUES = ((14.0, "red"), (38.0, "orange"), (68.0, "yellow"), (165.0, "green"), (203.0, "teal"),
        (252.0, "blue"), (300.0, "purple"), (338.0, "pink"), (360.0, "red"))  # fmt: skip
"""Up to which hue [deg] a word goes."""
WORDS = ("black", "gray", "white", "brown", *dict.fromkeys(word for _, word in HUES))
SECOND = 0.3
"""A share of the pixels from which on a colour is told besides the first."""
NORM, BELIEVED = 12, 0.5
"""Of a picture's colours, and how much of what it says of the light is taken off, as walls have
colours too: chosen on pictures that nothing is judged on."""
DIM, CLIPPED = 0.05, 0.98
"""Pixels whose brightest colour is between these tell of the light."""
LEAST_LIT = 1000
WARM_DEG, LEAST_PLAIN = 40.0, 12
"""The hue of cream, between orange and yellow; and pixels without a colour that tell of it, as
those of a label do not."""

Gain = NDArray[np.float32]


def white_balance(colours: NDArray[np.uint8]) -> Gain:
    """Gains of red, green and blue against the light's own colour, shape (3,).

    Shades of grey: the light has the colour of a norm of all pixels, between their mean and the
    brightest [Finlayson, Trezzi 2004]; and only half of it is believed.
    """
    rgb = colours.reshape(-1, 3).astype(np.float32) / np.float32(255.0)
    high = rgb.max(axis=1)
    lit = rgb[(high > DIM) & (high < CLIPPED)]
    if len(lit) < LEAST_LIT:
        return np.ones(3, dtype=np.float32)
    light = np.maximum((lit**NORM).mean(axis=0) ** (1.0 / NORM), 1e-3)
    return np.asarray((light.mean() / light) ** BELIEVED, np.float32)


def words(
    colours: NDArray[np.uint8], pixels: NDArray[np.bool_], gain: Gain | None = None
) -> tuple[str, ...]:
    """One or two words for the colours of a thing, most of it first.

    Args:
        colours: of the picture, red, green, blue, shape (height, width, 3).
        pixels: which show the thing, at least one.
        gain: of red, green and blue, as `white_balance` has it; none: the colours as they are.
    """
    rgb, high, low = _balanced(colours, pixels, gain)
    saturation = (high - low) / np.maximum(high, 1e-3)
    found = np.array(WORDS.index("gray")) * np.ones(len(rgb), dtype=np.intp)
    found[high < BLACK] = WORDS.index("black")
    found[high > WHITE] = WORDS.index("white")
    has_hue = (saturation > GREY) & (high > DARK)
    hue = _hues(rgb, high, low)
    limits = np.array([limit for limit, _ in HUES])
    named = np.array([WORDS.index(word) for _, word in HUES])[np.searchsorted(limits, hue)]
    pale_red = (named == WORDS.index("red")) & (saturation < PALE) & (high > DEEP)
    named[pale_red] = WORDS.index("pink")
    orange = (named == WORDS.index("orange")) & ((saturation < PALE) | (high < DEEP))
    named[orange] = WORDS.index("brown")
    found[has_hue] = named[has_hue]
    shares = np.bincount(found, minlength=len(WORDS)) / len(rgb)
    best = np.argsort(-shares)
    told = [WORDS[int(best[0])]]
    if shares[best[1]] > SECOND:
        told.append(WORDS[int(best[1])])
    return tuple(told)


def warmth(
    colours: NDArray[np.uint8], pixels: NDArray[np.bool_], gain: Gain | None = None
) -> float:
    """How much of the hue of cream a thing has: 0 white, 0.1 cream, below 0 a bluish grey.

    Args:
        colours: of the picture, red, green, blue, shape (height, width, 3).
        pixels: which show the thing, at least one.
        gain: of red, green and blue, as `white_balance` has it; none: the colours as they are.
    """
    rgb, high, low = _balanced(colours, pixels, gain)
    saturation = (high - low) / np.maximum(high, 1e-3)
    plain = (saturation < GREY) & (high > BLACK)
    if np.count_nonzero(plain) < LEAST_PLAIN:
        return 0.0
    turn = np.radians(_hues(rgb[plain], high[plain], low[plain]) - WARM_DEG)
    return float(np.median(saturation[plain] * np.cos(turn)))


def _balanced(
    colours: NDArray[np.uint8], pixels: NDArray[np.bool_], gain: Gain | None
) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.float32]]:
    """Red, green and blue of each pixel, shape (n, 3), the most and the least of them; 0 to 1."""
    rgb = colours[pixels].astype(np.float32) / np.float32(255.0)
    if gain is not None:
        rgb = np.minimum(rgb * gain, np.float32(1.0))
    return rgb, rgb.max(axis=1), rgb.min(axis=1)


def _hues(
    rgb: NDArray[np.float32], high: NDArray[np.float32], low: NDArray[np.float32]
) -> NDArray[np.float32]:
    """The hue of each pixel, from 0 to 360 degrees; 0 of what is grey."""
    span = np.maximum(high - low, np.float32(1e-6))
    red, green, blue = rgb[:, 0], rgb[:, 1], rgb[:, 2]
    hue = np.asarray((red - green) / span + np.float32(4.0), np.float32)
    most_green, most_red = high == green, high == red
    hue[most_green] = ((blue - red) / span + np.float32(2.0))[most_green]
    hue[most_red] = ((green - blue) / span % np.float32(6.0))[most_red]
    return np.asarray(np.float32(60.0) * hue, np.float32)
