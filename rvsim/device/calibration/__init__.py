"""What a calibration needs: poses that people recognise, in words, the arm's sag, and lines through marks."""
