"""When the next event of a ball is: contact with a ball, a cushion or a mouth, or the end of its motion state."""
