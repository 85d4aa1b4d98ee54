"""The form of a scene file, said once: reader, schema, edit list, handles and reference follow from it."""
