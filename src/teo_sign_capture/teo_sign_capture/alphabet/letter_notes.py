"""What must be said about single letters beside the numbers."""

from __future__ import annotations

_HANGING = (
    "TEO's wrist cannot bend the hand down: it hangs before the right breast instead of beside the face, its "
    "palm half as far down as the signer's."
)
_MOVES_ONLY = "Differs from {} by its movement from side to side only."
_FIST = "TEO's thumb cannot lie over the fist: it stands beside it, along the index."

NOTES: dict[str, str] = {
    "D": "The thumb meets middle and ring finger; the little finger stays a finger's width away.",
    "E": "A half-closed hand: the knuckles of TEO's fingers cannot stay straight under a claw.",
    "F": "The thumb stays beside the bent index, a finger's width away, instead of crossing it.",
    "G": "Moves from side to side, as recorded.",
    "H": "Two holds, beside the face and before the body, as recorded; the second is seen badly: doubtful.",
    "I": _FIST,
    "J": _FIST,
    "LL": _MOVES_ONLY.format("L"),
    "M": _HANGING,
    "N": f"{_HANGING} Arm as for M.",
    "Ñ": f"{_MOVES_ONLY.format('N')} {_HANGING} Arm as for M.",
    "Q": (
        "The recording's tracker of the hand lost it in 15 of 25 frames, while that of the body saw the arm "
        "stay: shape and palm are those seen before and after. A movement in between would not be seen. The "
        "thumb stays off the fingers."
    ),
    "R": "TEO's fingers cannot cross: index and middle stand side by side, closed, where U's part.",
    "RR": f"{_MOVES_ONLY.format('R')} Index and middle side by side instead of crossed.",
    "U": "TEO's fingers cannot spread: the index bends forwards a little, parting them from the front.",
    "V": f"{_MOVES_ONLY.format('U')} Spread as in U.",
    "W": "Moves from side to side. Spread shown by bending the index a little.",
    "X": "Hooked index; then the hand turns and draws back, as recorded; the index is seen badly then.",
    "Y": f"The little finger bends again and again. {_FIST}",
    "Z": f"The little finger draws the letter. {_FIST}",
}
