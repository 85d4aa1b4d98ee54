"""`python -m linkanim` is the `linkanim` command."""

from linkanim.cli import main

if __name__ == "__main__":
    raise SystemExit(main())
