"""Lines of text: faces, setting, letters with halos."""
