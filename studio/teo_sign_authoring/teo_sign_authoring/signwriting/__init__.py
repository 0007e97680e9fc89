# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Signs in SignWriting as sign scores.

A sign is read from Formal SignWriting (`written_sign`), its symbols are understood one by one (`handshapes`,
`orientation`, `movement`, `place`), and put together into a score of `notation` (`compiler`). What is not
understood is said, symbol by symbol; a sign whose movement is not understood is refused.

Bases and names of symbols are those of the International SignWriting Alphabet 2010 as Unicode 8 encodes it
(Sutton SignWriting, U+1D800 to U+1DAAF).
"""
