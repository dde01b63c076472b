"""What an event does: one file per physical interaction."""
