"""What every service works with: context, time, heartbeat, wake-ups, caches, warm-up."""
