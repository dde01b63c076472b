"""Other ways to do what the engine does, written to be fair opponents. They share no code with its kernels."""
