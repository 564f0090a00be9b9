% The same requests as in naive.pl as constraints over finite domains: a tuple of numbers for each
% device, pins and signals all different, labelling by cost. What docs/benchmarks.md calls CLP(FD):
%
%     swipl -q -g constraints -t halt benches/clpfd.pl
%
% prints the devices, the least cost and the processor time in seconds.

:- use_module(library(clpfd)).
:- prolog_load_context(directory, Folder),
   directory_file_path(Folder, 'naive.pl', File),
   load_files(File, []).

number_in(Things, Thing, Number) :- nth1(Number, Things, Thing).

% Pin, signal, pin, signal, ..., cost.
tuple(Pins, Signals, Kind, Tuple) :-
    serves(Kind, Wires),
    foldl(numbered(Pins, Signals), Wires, Numbers-[], []-Rest),
    Rest = [],
    aggregate_all(count, ( member(Pin-_, Wires), usage(Pin, _, _) ), Cost),
    append(Numbers, [Cost], Tuple).

numbered(Pins, Signals, Pin-Signal, [P, S | Left]-Done, Left-Done) :-
    number_in(Pins, Pin, P),
    number_in(Signals, Signal, S).

device(Pins, Signals, Kind, Tuple-Cost) :-
    findall(One, tuple(Pins, Signals, Kind, One), All),
    All = [First | _],
    same_length(First, Whole),
    tuples_in([Whole], All),
    append(Tuple, [Cost], Whole).

split([], [], []).
split([P, S | Rest], [P | Pins], [S | Signals]) :- split(Rest, Pins, Signals).

least(Kinds, Total) :-
    setof(Pin, Unit^Signal^usage(Pin, Unit, Signal), Pins),
    findall(S, ( member(K, [analog, i2c, icu]), serves(K, Wires), member(_-S, Wires) ), Found),
    sort(Found, Signals),
    maplist(device(Pins, Signals), Kinds, Devices),
    pairs_keys_values(Devices, Tuples, Costs),
    append(Tuples, Wires),
    split(Wires, OnPins, Carried),
    all_different(OnPins),
    all_different(Carried),
    sum(Costs, #=, Total),
    append(Wires, Costs, Variables),
    once(labeling([ff, min(Total)], Variables)).

constraints :-
    forall(member(Kinds,
                  [ [analog, analog, i2c, icu],
                    [analog, analog, analog, i2c, icu, icu, icu],
                    [analog, analog, analog, analog, i2c, icu, icu, icu] ]),
           ( statistics(cputime, Before),
             least(Kinds, Cost),
             statistics(cputime, After),
             Seconds is After - Before,
             length(Kinds, Devices),
             format("~w devices: least cost ~w, ~3f s~n", [Devices, Cost, Seconds]) )).
