# The runtime's sources, for the Makefile of an application; UPROXY is this folder.
UPROXYSRC := $(wildcard $(UPROXY)/core/*.c) $(wildcard $(UPROXY)/chibios/*.c)
UPROXYINC := $(UPROXY)/core $(UPROXY)/chibios
