"""A look-up table that notices when its directory changes."""

from __future__ import annotations

from teo_signs.errors import LutError
from teo_signs.look_up_table import Lut


class LiveLut:
    """Keeps a table up to date with its directory, at the cost of one `stat` a look."""

    def __init__(self, lut: Lut) -> None:
        """Follow a table."""
        self.lut = lut
        self._changed = lut.directory.stat().st_mtime_ns

    def refresh(self) -> str:
        """Read the table's directory again if a sign was saved or removed since.

        Returns:
            Why the table could not be read, in which case it stays as it was; else empty.
        """
        try:
            changed = self.lut.directory.stat().st_mtime_ns
            if changed != self._changed:
                self.lut.reload()
                self._changed = changed
        except OSError as error:
            return f"{self.lut.directory}: expected a directory of signs, got: {error.strerror}"
        except LutError as error:
            return str(error)
        return ""
