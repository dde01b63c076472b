"""Reports (docs/tournaments.md, "Reports"): complete, self-contained, and never markup from a name."""

import csv
import io
import json
from html.parser import HTMLParser
from typing import Any

import numpy as np
import pytest
from scipy import stats
from support.events import by_lot, play, result_of

from tournament import Entrant, Format, InvalidResult, NoisePlan, Spec, SprtTerms, Tournament
from tournament.luck import GameLuck, StrokeLuck
from tournament.report import COLUMNS, csv_text, event_report, json_lines, page, read_json_lines, server_report

NASTY = ["<script>alert(1)</script>", '"><img src=x onerror=alert(1)>', "=cmd|' /C calc'!A0", "Zoë & Ødegård {{7*7}}"]
RECORDS = [
    "records/one game.jsonl",
    "https://example.org/games/1/record",
    "javascript:alert(1)",
    "../../etc/passwd",
    "",
]


def nasty_event(**terms: Any) -> Tournament:
    """A finished event of entrants with names that want to be more than text."""
    choose = by_lot(5)
    event = Tournament(Spec("Open <b>&</b> noisy", tuple(Entrant(name) for name in NASTY), **terms))
    results = [
        result_of(
            due,
            choose(due),
            record=RECORDS[due.pair.number % 5],
            fouls=({"R33": 1, "<i>": 2}, {}),
            strokes=(5, 7),
            seconds=(1.5, 2.0),
        )
        for due in event.due
    ]
    return event.with_results(*results)


class Reader(HTMLParser):
    """Collects tags, links and text, and checks that tags close."""

    VOID = frozenset(("meta", "line", "circle", "br"))

    def __init__(self):
        super().__init__()
        self.open, self.tags, self.attributes, self.words = [], [], [], []

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        self.attributes += attrs
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.tags.append(tag)
        self.attributes += attrs

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.words.append(data)


def read(html: str) -> Reader:
    reader = Reader()
    reader.feed(html)
    reader.close()
    assert reader.open == []
    return reader


@pytest.fixture(params=["event", "server"])
def report(request):
    event = nasty_event(noise=NoisePlan((0.0, 1.0, 5.0)), pairs=3)
    return event_report(event) if request.param == "event" else server_report("Standing", event.results)


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ("olympiad", "olympiad"),
        ({"name": "nine_foot"}, "nine_foot"),
        ({"name": "nine_foot", "mu_slide": 0.25, "cushion": "factors"}, "nine_foot, mu_slide 0.25, cushion factors"),
    ],
)
def test_the_terms_name_the_table_and_what_is_otherwise_on_it(table, said):
    reader = read(page(event_report(nasty_event(table=table))))
    assert reader.words[reader.words.index("Table") + 1] == said


def test_names_are_text_and_never_markup(report):
    reader = read(page(report))
    assert not {"script", "img", "i", "b", "iframe", "link", "object"} & set(reader.tags)
    for name in NASTY:
        assert any(name in word for word in reader.words), name
    assert not any(key.startswith("on") for key, _ in reader.attributes)


def test_only_web_addresses_and_plain_paths_become_links(report):
    targets = {value for key, value in read(page(report)).attributes if key == "href"}
    assert targets == {"records/one%20game.jsonl", "https://example.org/games/1/record"}


def test_the_page_asks_for_nothing_and_says_so(report):
    reader = read(page(report))
    assert not [value for key, value in reader.attributes if key in ("src", "xlink:href", "srcset", "action")]
    (policy,) = [value for key, value in reader.attributes if key == "content" and "default-src" in value]
    assert policy.startswith("default-src 'none'")
    assert "url(" not in page(report)
    assert "@import" not in page(report)


def test_plots_are_images_with_words_and_tables_have_captions(report):
    html = page(report)
    reader = read(html)
    assert reader.tags.count("svg") == 2
    assert html.count('role="img"') == 2
    assert reader.tags.count("title") == 1 + 2
    assert reader.tags.count("caption") == reader.tags.count("table") >= 7
    identities = [value for key, value in reader.attributes if key == "id"]
    assert len(set(identities)) == len(identities)


def test_the_data_is_json_and_holds_every_game(report):
    again = json.loads(json.dumps(report, allow_nan=False))
    assert page(again) == page(report)
    assert len(again["games"]) == 36
    assert {"ratings", "scores", "meetings", "noise", "fouls", "time", "ends", "luck"} <= set(again)


def test_terms_tell_neither_seed_nor_commands():
    event = Tournament(Spec("e", (Entrant("a", "python secret.py"), Entrant("b")), seed="5a" * 32))
    data = json.dumps(event_report(event))
    assert "5a5a" not in data
    assert "secret" not in data


def test_an_event_that_rates_nobody_says_so_and_has_no_superiority():
    data = event_report(nasty_event(), rated=False)
    assert (data["ratings"], data["superiority"]["names"]) == ([], [])
    html = page(data)
    read(html)
    assert "Nobody is rated" in html
    assert "<h2>Superiority" not in html
    assert "<h2>Superiority" in page(event_report(nasty_event()))


@pytest.mark.parametrize("kind", ["round_robin", "swiss", "knockout", "gauntlet"])
def test_an_event_before_its_first_game_has_a_page(kind):
    terms = {"format": kind, "rounds": 2 if kind == "swiss" else None}
    data = event_report(Tournament(Spec("e", tuple(Entrant(name) for name in "abc"), **terms)))
    assert "No games yet." in page(data)
    assert not data["state"]["finished"]
    assert data["state"]["due"] > 0


def test_a_server_without_games_has_a_page():
    read(page(server_report("empty", [])))


def test_a_sequential_test_is_told():
    event = play(
        Tournament(Spec("e", (Entrant("a"), Entrant("b")), pairs=100, sprt=SprtTerms(0, 100))),
        lambda due: due.pair.players.index("a"),
    )
    html = page(event_report(event))
    assert "accepted: at least 100 Elo" in html


def test_luck_is_shown_when_it_is_known():
    event = nasty_event()
    game = event.counted[0]
    luck = GameLuck(game.players, 1.0, (StrokeLuck(0, 0, 0.7, 0.5, 0.01, 0.6),), game.points)
    data = event_report(event, {(game.pair, game.leg): luck})
    row = next(row for row in data["luck"] if row["name"] == game.players[0])
    assert row["luck"] == pytest.approx(0.2)
    assert row["corrected"] == pytest.approx(game.points[0] - 0.2)
    assert (row["pairs"], row["corrected_low"]) == (1, None)
    assert "without luck" in page(data)


def test_scores_without_luck_have_intervals_over_pairs():
    """Two pairs of two games: scipy's t interval of the two means of pairs."""
    event = play(Tournament(Spec("e", (Entrant("a"), Entrant("b")), pairs=2)), lambda due: due.pair.players.index("a"))
    lucks = dict(zip([(game.pair, game.leg) for game in event.counted], (0.1, 0.3, -0.1, 0.2), strict=True))
    luck = {
        (game.pair, game.leg): GameLuck(
            game.players,
            1.0,
            (StrokeLuck(0, game.seat("a"), 0.5 + lucks[game.pair, game.leg], 0.5, 0.0, 0.5),),
            game.points,
        )
        for game in event.counted
    }
    data = event_report(event, luck)
    row = next(row for row in data["luck"] if row["name"] == "a")
    means = [1 - 0.2, 1 - 0.05]
    expected = stats.t.interval(0.95, 1, np.mean(means), stats.sem(means))
    assert (row["corrected"], row["pairs"]) == (pytest.approx(np.mean(means)), 2)
    assert (row["corrected_low"], row["corrected_high"]) == pytest.approx(expected)
    assert (row["luck_low"], row["luck_high"]) == pytest.approx((1 - expected[1], 1 - expected[0]))
    assert row["score_low"] is None
    assert f"{expected[0]:.3f}" in page(data)


def test_superiority_and_both_kinds_of_intervals_are_told(report):
    html, matrix = page(report), report["superiority"]
    assert matrix["names"] == [one["name"] for one in report["ratings"]]
    first = np.array(matrix["likelihoods"])
    assert first.shape == (4, 4)
    assert np.allclose(first + first.T, 1.0, atol=2e-4)
    assert first[0, -1] >= 0.5
    assert all(word in html for word in ("marginal", "simultaneous", "Rank", "bootstrap over pairs"))
    assert f"{100 * first[0, 1]:.1f}" in html


def test_a_thousand_entrants_still_fit():
    """A crowd: plots and cross table show the first, the tables all."""
    spec = Spec("crowd", tuple(Entrant(f"p{index}") for index in range(60)), format=Format.GAUNTLET)
    html = page(event_report(play(Tournament(spec), by_lot(1))))
    assert html.count("p59") >= 3
    read(html)


def test_results_survive_json_lines():
    results = nasty_event().results
    assert tuple(read_json_lines(json_lines(results))) == results


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("{", "line 2"),
        ("3", "line 2, result = 3: must be an object"),
        ('{"leg": 1}', "line 2, pair = None: must be given"),
    ],
)
def test_a_broken_line_is_named(line, words):
    good = next(json_lines(nasty_event().results))
    with pytest.raises(InvalidResult, match=words):
        list(read_json_lines([good, line]))


def test_the_comma_separated_values_are_read_back_and_run_no_formula():
    results = nasty_event().results
    rows = list(csv.DictReader(io.StringIO(csv_text(results))))
    assert tuple(rows[0]) == COLUMNS
    assert len(rows) == len(results)
    assert not [cell for row in rows for cell in row.values() if cell.startswith(("=", "+", "@"))]
    assert float(rows[0]["points_0"]) + float(rows[0]["points_1"]) == 1.0
