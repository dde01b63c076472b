"""Tokens of organisers, administrators and readers, and invitations to register."""

from fastapi import APIRouter, Response

from protocol import InvitationRequest, Invitations, TokenList, TokenRequest, TokenSecret
from server.errors import Forbidden, Invalid, WrongStatus
from server.http.dependencies import Authenticated, ContextDep, Limit, PageDep, Sent, respond
from server.http.describe import OWNED, describe
from server.services.accounts import tokens

router = APIRouter(prefix="/v1", tags=["tokens"])


@router.post(
    "/tokens",
    **describe(Forbidden, body=TokenRequest, success={201: TokenSecret}, key=True),
    summary="Make a token",
)
def create(context: ContextDep, command: Sent) -> Response:
    """For an organiser, an administrator or a reader; agents get theirs by registering. For administrators."""
    return respond(tokens.create(context, command))


@router.get("/tokens", **describe(Forbidden, Invalid), summary="The tokens that are not agents'")
def listing(context: ContextDep, caller: Authenticated, after: PageDep, limit: Limit) -> TokenList:
    """Without the tokens themselves: those are shown once. For administrators."""
    return tokens.listing(context, caller, after, limit)


@router.post(
    "/tokens/{token_id}/rotate",
    **describe(*OWNED, WrongStatus, success={200: TokenSecret}, key=True),
    summary="Rotate a token",
)
def rotate(token_id: str, context: ContextDep, command: Sent) -> Response:
    """A new one under the same id; the old one is void from now on. For administrators."""
    return respond(tokens.rotate(context, token_id, command))


@router.delete("/tokens/{token_id}", **describe(*OWNED, success={204: ""}), summary="Revoke a token")
def revoke(token_id: str, context: ContextDep, caller: Authenticated) -> Response:
    """For good. For administrators."""
    tokens.revoke(context, token_id, caller)
    return Response(status_code=204)


@router.post(
    "/invitations",
    **describe(Forbidden, body=InvitationRequest, success={201: Invitations}, key=True),
    summary="Invite to register",
)
def invite(context: ContextDep, command: Sent) -> Response:
    """Codes, each good for one registration. For organisers."""
    return respond(tokens.invite(context, command))
