"""Tasks of navigation, and what follows an episode of one: for ostium.gym, for the learner, and without Gymnasium."""

from .course import Course, Patient, patient, points_along, spaces_of
from .tasks import TASKS, Moment, Task

__all__ = ["TASKS", "Course", "Moment", "Patient", "Task", "patient", "points_along", "spaces_of"]
