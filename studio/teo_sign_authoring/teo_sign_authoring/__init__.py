# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Writing signs: sign scores, SignWriting, the manual alphabet, easier postures, tables of other robots.

Each room imports only rooms above it in this list:

    notation            sign scores, and the robot that performs them
    alphabet            letters and numbers, from recordings of hands
    easing              postures of words that are quicker to reach
    signwriting         signs in SignWriting, as sign scores
    transfer            a language's table for another robot
    cli                 the commands
"""
