"""Tasks of navigation, and what follows an episode of one: for ostium.gym, for the learner, and without Gymnasium."""

from .course import Course, Patient, patient, points_along, spaces_of
from .demonstration import Demonstration, baseline, demonstrate
from .tasks import TASKS, Moment, Task

__all__ = ["TASKS", "Course", "Demonstration", "Moment", "Patient", "Task", "baseline", "demonstrate", "patient",
           "points_along", "spaces_of"]
