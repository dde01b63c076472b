"""The physics alone, for clients in any language, on threads of its own."""
