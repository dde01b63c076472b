"""Which names look alike: one agent must not be taken for another.

Names that look alike have the same *skeleton*, as in UTS #39 (Unicode Security Mechanisms, section 4): look-alike
characters are replaced by one of them and the results are compared. Here case counts as a look-alike too, and so do
spaces and dots at the ends, and several spaces for one, which a page shows as one.
"""

import re
import unicodedata
from typing import Final

LONGEST_SKELETON: Final = 128
"""Characters: an `m` becomes two."""

CONFUSABLES: Final = {"0": "o", "1": "l", "i": "l", "m": "rn"}
"""From Unicode's confusables.txt 14.0.0 (https://www.unicode.org/Public/security/14.0.0/confusables.txt), the lines
whose source is a character of a name: 0030 → 004F, 0031 → 006C, 0049 → 006C, 006D → 0072 006E. Both sides are in lower
case here, since I looks like l, and i is the same name as I. Names are ASCII: no other line applies."""

_LOOK_ALIKES: Final = str.maketrans(CONFUSABLES)
_IGNORED_AT_THE_ENDS: Final = " ."


def skeleton(name: str) -> str:
    """What all names that look like this one have in common. It is for comparison, and is shown to nobody."""
    folded = unicodedata.normalize("NFKC", name).casefold().strip(_IGNORED_AT_THE_ENDS)
    return re.sub(r"\s+", " ", folded).translate(_LOOK_ALIKES)
