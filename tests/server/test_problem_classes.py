"""`ProblemCode` is the one table of problems: codes, statuses, and the exception classes of server and client."""

import pytest

from client import errors as client_errors
from protocol import ProblemCode
from server import errors as server_errors

GROUPS = {"BadRequest": {400}, "Conflict": {409}, "Unprocessable": {422}, "ServerError": {500, 503}}
"""Classes of `client.errors` that stand for a status."""


def below(base):
    return [kind for child in base.__subclasses__() for kind in (child, *below(child))]


def camel(code):
    return "".join(word.capitalize() for word in code.split("_"))


@pytest.mark.parametrize(
    ("base", "others"),
    [(server_errors.ServerError, {"TwoLengths", "TooManyOpen", "HeadTooLarge"}), (client_errors.ApiError, set(GROUPS))],
    ids=["server", "client"],
)
def test_every_code_has_its_class_and_every_class_its_code(base, others):
    kinds = {kind.__name__: kind for kind in below(base) if kind.__module__ in ("server.errors", "client.errors")}
    assert set(kinds) == {camel(code) for code in ProblemCode} | others
    assert all(kinds[camel(code)].code is code for code in ProblemCode)


def test_what_is_a_kind_of_another_problem_has_its_code():
    assert server_errors.TwoLengths.code is ProblemCode.BAD_HEADER
    assert server_errors.TooManyOpen.code is ProblemCode.TOO_MANY_REQUESTS
    assert server_errors.HeadTooLarge.code is ProblemCode.TOO_LARGE


def test_the_clients_groups_are_statuses():
    """`except Conflict` catches every 409 and nothing else."""
    for name, statuses in GROUPS.items():
        group = getattr(client_errors, name)
        assert group.code is None
        inside = {code for code in ProblemCode if issubclass(getattr(client_errors, camel(code)), group)}
        assert inside == {code for code in ProblemCode if code.status in statuses}
