"""`/docs`: the whole OpenAPI document as a page that needs no script and no other host."""

import re
from html import unescape

import pytest

from server.reference import reference
from server.routes.page import HEADERS


@pytest.fixture(scope="module")
def answer(server):
    response = server.request("GET", "/docs")
    assert response.status_code == 200, response.text
    return response


def test_it_keeps_the_pages_policy_and_is_asked_for_once(server, answer):
    assert {name: answer.headers[name] for name in HEADERS} == HEADERS
    assert answer.headers["content-type"] == "text/html; charset=utf-8"
    again = server.request("GET", "/docs", headers={"If-None-Match": answer.headers["etag"]})
    assert again.status_code == 304


def test_nothing_is_run_and_nothing_comes_from_elsewhere(server, answer):
    assert not re.search(r"<script|<style|<iframe|\son\w+=|\sstyle=", answer.text)
    sources = re.findall(r'(?:src|href)="([^"]*)"', answer.text)
    assert {source for source in sources if not source.startswith("#")} == {
        *("/", "/openapi.json", "/web/icon.svg", "/web/style.css", "/web/reference.css")
    }
    assert server.request("GET", "/web/reference.css").status_code == 200


def test_every_operation_and_every_field_of_every_message_is_there(server, answer):
    document, text = server.request("GET", "/openapi.json").json(), unescape(answer.text)
    for path, methods in document["paths"].items():
        for method, operation in methods.items():
            assert f"<h3><code>{method.upper()} {path}</code> {operation['summary']}</h3>" in text
    for name, schema in document["components"]["schemas"].items():
        section = re.search(f'<section id="{name}">(.*?)</section>', text, re.DOTALL)[1]
        for field in schema.get("properties", ()):
            assert f"<code>{field}</code>" in section


def test_every_link_leads_somewhere_and_places_have_one_name(answer):
    places = re.findall(r'id="([^"]+)"', answer.text)
    assert len(places) == len(set(places))
    assert set(re.findall(r'href="#([^"]+)"', answer.text)) <= set(places)


def test_what_a_document_says_is_text():
    """Names and descriptions are never markup."""
    evil = "<img src=x onerror=alert(1)>"
    operation = {"summary": evil, "description": evil, "tags": [evil], "responses": {evil: {"description": evil}}}
    schema = {"description": evil, "properties": {evil: {"type": evil, "default": evil, "description": evil}}}
    info = {"title": evil, "version": evil, "description": evil}
    page = reference({"info": info, "paths": {"/": {"get": operation}}, "components": {"schemas": {"A": schema}}})
    assert "<img src=x" not in page
    assert page.count("&lt;img") >= 10
