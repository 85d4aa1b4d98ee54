# 08  All recordings of a slide deck by one command:  make -f 08-slides.mk
# A recording is made again when its line here changes, and none twice; -j 2 makes two at a time.
LINKANIM ?= linkanim
SIZE     ?= 1280x720

DECK = opening.gif press.mp4 limits.gif
all: $(DECK)

opening.gif: 08-slides.mk
	$(LINKANIM) record jansen --size $(SIZE) -o $@
press.mp4: 08-slides.mk
	$(LINKANIM) record press --size $(SIZE) --vectors v --chart 5.travel_velocity -o $@
limits.gif: 08-slides.mk
	$(LINKANIM) record double-rocker --size $(SIZE) --theme dark -o $@

clean:
	rm -f $(DECK)
.PHONY: all clean
