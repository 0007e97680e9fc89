# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What is signed: output words while a sentence is put together, the signs that show them, and its tokens.

An `OutputWord` is a gloss, a spelled word, a number or a pause, with the typed words that it says.
`SignChooser` makes it of what has signs. A `Translation` holds the numbered tokens of all sentences.
"""
