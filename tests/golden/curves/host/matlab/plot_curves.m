function plot_curves(file)
% Plots a record of the design curves: plot_curves('run.mcap'). Generated: copy it to start a
% script of your own.
if nargin < 1
    help plot_curves
    return;
end
run = read_record(file);

figure('Name', 'Rover');
subplot(6, 2, 1);
plot(run.Rover.Ranger.t, run.Rover.Ranger.value, '.-');
title('a GP2Y0A21 behind the bumper', 'Interpreter', 'none');
xlabel('s');
ylabel('cm', 'Interpreter', 'none');
subplot(6, 2, 2);
plot(run.Rover.Line.t, run.Rover.Line.value, '.-');
title('Line', 'Interpreter', 'none');
xlabel('s');
ylabel('percent', 'Interpreter', 'none');
subplot(6, 2, 3);
plot(run.Rover.Bumper.t, run.Rover.Bumper.value, '.-');
title('Bumper', 'Interpreter', 'none');
xlabel('s');
ylabel('', 'Interpreter', 'none');
subplot(6, 2, 4);
plot(run.Rover.Wheels.t, run.Rover.Wheels.value, '.-');
title('Wheels', 'Interpreter', 'none');
xlabel('s');
ylabel('', 'Interpreter', 'none');
subplot(6, 2, 5);
plot(run.Rover.Bent.t, run.Rover.Bent.value, '.-');
title('Bent', 'Interpreter', 'none');
xlabel('s');
ylabel('', 'Interpreter', 'none');
subplot(6, 2, 6);
plot(run.Rover.Escs.t, run.Rover.Escs.value, '.-');
title('Escs', 'Interpreter', 'none');
xlabel('s');
ylabel('percent', 'Interpreter', 'none');
subplot(6, 2, 7);
plot(run.Rover.Lamps.t, run.Rover.Lamps.value, '.-');
title('Lamps', 'Interpreter', 'none');
xlabel('s');
ylabel('', 'Interpreter', 'none');
subplot(6, 2, 8);
plot(run.Rover.Winch.t, run.Rover.Winch.value, '.-');
title('Winch', 'Interpreter', 'none');
xlabel('s');
ylabel('N', 'Interpreter', 'none');
subplot(6, 2, 9);
plot(run.Rover.Acceleration.t, run.Rover.Acceleration.value, '.-');
title('Acceleration', 'Interpreter', 'none');
xlabel('s');
ylabel('g', 'Interpreter', 'none');
subplot(6, 2, 10);
plot(run.Rover.Rate.t, run.Rover.Rate.value, '.-');
title('Rate', 'Interpreter', 'none');
xlabel('s');
ylabel('deg/s', 'Interpreter', 'none');
subplot(6, 2, 11);
plot(run.Rover.Speed.t, run.Rover.Speed.value, '.-');
title('Speed', 'Interpreter', 'none');
xlabel('s');
ylabel('%', 'Interpreter', 'none');
subplot(6, 2, 12);
plot(run.Rover.Position.t, run.Rover.Position.value, '.-');
title('Position', 'Interpreter', 'none');
xlabel('s');
ylabel('deg', 'Interpreter', 'none');
end
