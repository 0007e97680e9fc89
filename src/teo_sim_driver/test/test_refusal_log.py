from teo_sim_driver.errors import Refusal, TrajectoryError
from teo_sim_driver.refusal_log import RefusalLog

NAN = TrajectoryError(Refusal.NOT_FINITE, "point 0: expected a finite number")
LATE = TrajectoryError(Refusal.ENDS_IN_THE_PAST, "the last point was due 3 s ago")


def test_a_refusal_is_logged_with_its_code_and_reason():
    assert RefusalLog().line(NAN, 5.0) == (
        "trajectory refused (not_finite): point 0: expected a finite number"
    )


def test_a_flood_is_counted_and_its_size_is_told():
    log = RefusalLog()
    lines = [log.line(NAN, i * 0.001) for i in range(2001)]
    told = [line for line in lines if line]
    assert len(told) == 3
    assert told[1].endswith("[999 more of this code since the last line]")


def test_another_reason_is_logged_at_once():
    log = RefusalLog()
    assert log.line(NAN, 0.0)
    assert log.line(LATE, 0.001)
