"""Families of scenes without end: room:N and street:N, each drawn by its number from the densities of densities.py."""
from .refusals import first_accepted
from .rooms import Room
from .streets import Street

FAMILIES = {"room": Room, "street": Street}
LARGEST_NUMBER = 999_999


def drawn(family, number):
    """(model, scene.json, files beside it) of the first draw that no rule refuses."""
    accepted, _ = first_accepted(f"{family}:{number}", FAMILIES[family])
    return accepted.scene()


def refusals_of(family, number):
    """The rules that refused the draws before it."""
    return first_accepted(f"{family}:{number}", FAMILIES[family])[1]
