% ---- search: depth first over the devices, never beyond the best so far ----
:- use_module(library(lists)).
:- dynamic best/2.

main :-
    retractall(best(_, _)),
    asserta(best(none, [])),
    findall(D, device(D), Devices),
    (   wire_all(Devices, state([], [], [], [], []), Wires, State),
        served(State),
        objective(State, Objective),
        improves(Objective),
        retractall(best(_, _)),
        asserta(best(Objective, Wires)),
        fail
    ;   true
    ),
    best(Found, Answer),
    (   Found = o(Violated, Shared, Cost, Spares)
    ->  format("violated ~w~nshared ~w~ncost ~w~nspares ~w~n", [Violated, Shared, Cost, Spares]),
        forall(member(D-Pin-Signal, Answer), format("~w ~w ~w~n", [D, Pin, Signal]))
    ;   format("infeasible~n")
    ).

improves(Objective) :-
    best(Best, _),
    ( Best == none -> true ; Objective @< Best ).

% state(Pins, Claims, Rules, DmaUsers, Spares); Pins are Pin-Holder-Device.
wire_all([], State, [], State).
wire_all([Device | Devices], State0, Wires, State) :-
    alternative(Device, _, Spares, Rules, Claims, Users, Roles),
    State0 = state(Pins0, Claims0, Rules0, Users0, Spares0),
    take_claims(Claims, Device, Claims0, Claims1),
    union(Rules, Rules0, Rules1),
    union(Users, Users0, Users1),
    union(Spares, Spares0, Spares1),
    wire_roles(Roles, Device, state(Pins0, Claims1, Rules1, Users1, Spares1), Here, State1),
    objective(State1, Bound),
    improves(Bound),
    wire_all(Devices, State1, Rest, State),
    append(Here, Rest, Wires).

wire_roles([], _, State, [], State).
wire_roles([Role | Roles], Device, state(P0, C0, R0, U, S), [Device-Pin-Signal | Wires], State) :-
    member(wire(Pin, Signal, Holder, Claims, Rules), Role),
    take_pin(Pin, Holder, Device, P0, P1),
    take_claims(Claims, Device, C0, C1),
    union(Rules, R0, R1),
    wire_roles(Roles, Device, state(P1, C1, R1, U, S), Wires, State).

% A pin, and a resource, has one holder; a group may hold it for several devices.
take_pin(Pin, Holder, Device, Pins, [Pin-Holder-Device | Pins]) :-
    \+ member(Pin-_-_, Pins), !.
take_pin(Pin, Holder, Device, Pins, [Pin-Holder-Device | Pins]) :-
    Holder \== own,
    forall(member(Pin-Other-By, Pins), ( Other == Holder, By \== Device )).

take_claims([], _, Claims, Claims).
take_claims([Resource-Holder | More], Device, Claims0, Claims) :-
    forall(
        member(Resource-Other-By, Claims0),
        ( By == Device -> true ; Holder \== own, Other == Holder )
    ),
    take_claims(More, Device, [Resource-Holder-Device | Claims0], Claims).

% o(Violated, Shared, Cost, Spares) in the standard order of terms.
objective(state(Pins, _, Rules, _, Spares), o(Violated, Shared, Cost, Count)) :-
    length(Rules, Violated),
    length(Spares, Count),
    findall(Pin, member(Pin-_-_, Pins), All),
    sort(All, Distinct),
    findall(C, ( member(Pin, Distinct), pin(Pin, C, _) ), Costs),
    sum_list(Costs, Cost),
    findall(S, ( member(Pin, Distinct), pin(Pin, _, S) ), Ones),
    sum_list(Ones, Shared).

% Each DMA request gets a stream of its own.
served(state(_, _, _, Users, _)) :-
    findall(R, ( member(U, Users), dma(U, Rs), member(R, Rs) ), Requests),
    streams(Requests, []), !.

streams([], _).
streams([Request | Requests], Taken) :-
    member(Stream, Request),
    \+ member(Stream, Taken),
    streams(Requests, [Stream | Taken]).
