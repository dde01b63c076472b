"""For whoever runs the server: logs and metrics."""
