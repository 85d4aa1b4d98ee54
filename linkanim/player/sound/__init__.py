"""What is to be heard of the motion and of answers: which sound, its wave, and the loudspeaker."""
