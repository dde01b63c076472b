"""client.notation: a position in one line, and back to the same bits."""

import pytest
from hypothesis import given
from support.scenes import scenes

import physics
from client import notation


@given(scenes())
def test_a_position_comes_back_bit_for_bit(scene):
    state = physics.TableState.from_positions(scene.positions)
    assert notation.read(notation.write(state)) == state


def test_the_form_is_the_documented_one():
    state = physics.TableState.from_positions({3: (0.4, 0.6), 0: (0.5, 1.7)})
    assert notation.write(state) == "0:0.5,1.7 3:0.4,0.6"


@pytest.mark.parametrize("text", ["0", "0:1", "0:1,2,3", "x:0.5,0.5", "16:0.5,0.5", "0:nan,0.5", "0:a,b"])
def test_other_forms_are_refused_with_the_word(text):
    with pytest.raises(physics.InvalidState):
        notation.read(text)
