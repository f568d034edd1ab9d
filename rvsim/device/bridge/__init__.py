"""The encoder bridge: our framed protocol, set-points down and measured angles up. resources/help/encoder-bridge.md."""
