"""What must be said about single letters beside the numbers."""

from __future__ import annotations

_HANGING = (
    "TEO's wrist cannot bend the hand down: it hangs before the right breast instead of beside the face, its "
    "palm half as far down as the signer's."
)
_MOVES_ONLY = "Differs from {} by its movement from side to side only."
_THUMB_OUT = (
    "TEO's thumb cannot stand out from the hand: it points along the index, a finger's width beside it."
)
_NO_TOUCH = (
    "Thumb and index cannot touch on TEO's hand: they meet for a viewer in front, with a gap in depth."
)
_FIST = "TEO's thumb cannot lie over the fist: it stays along the index."

NOTES: dict[str, str] = {
    "C": "TEO's thumb cannot stand opposite the fingers: the opening of the C is narrow.",
    "CH": _THUMB_OUT,
    "D": "TEO's thumb does not reach the bent fingers.",
    "E": _FIST,
    "F": "The thumb stays beside the bent index instead of crossing it.",
    "G": "Moves from side to side, as recorded.",
    "H": "Two holds, beside the face and before the body, as recorded; the second is seen badly: doubtful.",
    "I": _FIST,
    "J": _FIST,
    "L": _THUMB_OUT,
    "LL": f"{_MOVES_ONLY.format('L')} {_THUMB_OUT}",
    "M": _HANGING,
    "N": f"{_HANGING} Arm as for M.",
    "Ñ": f"{_MOVES_ONLY.format('N')} {_HANGING} Arm as for M.",
    "O": _NO_TOUCH,
    "Q": (
        "The recording shows the hand end-on and its landmarks jump: handshape (bunched) and forearm turn "
        "are written down from what is seen before, in and after the stroke, not measured. Doubtful."
    ),
    "R": "TEO's fingers cannot cross: index and middle stand side by side, closed, where U's part.",
    "RR": f"{_MOVES_ONLY.format('R')} Index and middle side by side instead of crossed.",
    "S": _NO_TOUCH,
    "T": _NO_TOUCH,
    "U": "TEO's fingers cannot spread: the index bends forwards a little, parting them from the front.",
    "V": f"{_MOVES_ONLY.format('U')} Spread as in U.",
    "W": "Moves from side to side. Spread shown by bending the index a little.",
    "X": "Hooked index; then the hand turns and draws back, as recorded; the index is seen badly then.",
    "Y": f"The little finger bends again and again. {_FIST}",
    "Z": f"The little finger draws the letter. {_FIST}",
}
