% Generate and test in the manner of the paper, on its table: every wiring of the devices is made and
% the cheapest is kept. What the ratio to naive Prolog in docs/benchmarks.md is measured with:
%
%     swipl -q -g main -t halt benches/naive.pl
%
% prints the number of wirings, the least cost and the processor time in seconds.

% usage(Pin, Peripheral, Signal).
usage(pa1, adc123, in1).
usage(pa1, tim2, ch2).
usage(pa1, tim5, ch2).
usage(pa2, adc123, in2).
usage(pa2, tim9, ch1).
usage(pa3, adc123, in3).
usage(pa3, tim9, ch2).
usage(pa8, i2c3, scl).
usage(pb0, adc12, in8).
usage(pb1, adc12, in9).
usage(pb4, tim3, ch1).
usage(pb5, tim3, ch2).
usage(pb6, i2c1, scl).
usage(pb7, i2c1, sda).
usage(pb7, tim4, ch2).
usage(pb8, i2c1, scl).
usage(pb8, tim10, ch1).
usage(pb9, i2c1, sda).
usage(pb10, i2c2, scl).
usage(pb11, i2c2, sda).
usage(pb14, tim12, ch1).
usage(pb15, tim12, ch2).
usage(pc1, adc123, in11).
usage(pc2, adc123, in12).
usage(pc4, adc12, in14).
usage(pc5, adc12, in15).
usage(pc6, tim3, ch1).
usage(pc6, tim8, ch1).
usage(pc9, i2c3, sda).
usage(pe5, tim9, ch1).
usage(pe6, tim9, ch2).
usage(pe9, tim1, ch1).
usage(pe11, tim1, ch2).

serves(analog, [Pin-Signal]) :- usage(Pin, Unit, Signal), memberchk(Unit, [adc12, adc123]).
serves(i2c, [Clock-scl(Unit), Data-sda(Unit)]) :- usage(Clock, Unit, scl), usage(Data, Unit, sda).
serves(icu, [Pin-Unit/Signal]) :- usage(Pin, Unit, Signal), memberchk(Signal, [ch1, ch2]).

wiring([], _, []).
wiring([Kind|Kinds], Used, [Wires|Rest]) :-
    serves(Kind, Wires),
    \+ ( member(Pin-Signal, Wires), ( memberchk(Pin-_, Used) ; memberchk(_-Signal, Used) ) ),
    append(Wires, Used, Now),
    wiring(Kinds, Now, Rest).

cost(Wiring, Cost) :-
    append(Wiring, Wires),
    findall(1, ( member(Pin-_, Wires), usage(Pin, _, _) ), Ones),
    length(Ones, Cost).

best(Kinds) :-
    nb_setval(best, none),
    nb_setval(count, 0),
    (   wiring(Kinds, [], Wiring),
        cost(Wiring, Cost),
        nb_getval(count, Count), Next is Count + 1, nb_setval(count, Next),
        nb_getval(best, Best),
        ( Best == none -> true ; Cost < Best ),
        nb_setval(best, Cost),
        fail
    ;   true
    ).

run(Kinds) :-
    statistics(cputime, Start),
    best(Kinds),
    statistics(cputime, End),
    Time is End - Start,
    nb_getval(best, Best), nb_getval(count, Count), length(Kinds, Number),
    format("~w devices: ~w wirings, least cost ~w, ~3f s~n", [Number, Count, Best, Time]).

main :-
    run([analog, analog, i2c, icu]),
    run([analog, analog, i2c, icu, icu]),
    run([analog, analog, analog, i2c, icu, icu]),
    run([analog, analog, analog, i2c, icu, icu, icu]).
