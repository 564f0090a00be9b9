function plot_fig2(file)
% Plots a record of the design fig2: plot_fig2('run.mcap'). Generated: copy it to start a
% script of your own.
if nargin < 1
    help plot_fig2
    return;
end
run = read_record(file);

figure('Name', 'STM32F4DiscoveryBoard');
subplot(4, 1, 1);
plot(run.STM32F4DiscoveryBoard.IRFront.t, run.STM32F4DiscoveryBoard.IRFront.value, '.-');
title('IRFront', 'Interpreter', 'none');
xlabel('s');
ylabel('', 'Interpreter', 'none');
subplot(4, 1, 2);
plot(run.STM32F4DiscoveryBoard.IRFrontRight.t, run.STM32F4DiscoveryBoard.IRFrontRight.value, '.-');
title('IRFrontRight', 'Interpreter', 'none');
xlabel('s');
ylabel('', 'Interpreter', 'none');
subplot(4, 1, 3);
plot(run.STM32F4DiscoveryBoard.USRear.t, run.STM32F4DiscoveryBoard.USRear.value, '.-');
title('USRear', 'Interpreter', 'none');
xlabel('s');
ylabel('cm', 'Interpreter', 'none');
subplot(4, 1, 4);
plot(run.STM32F4DiscoveryBoard.WheelEncoder.t, run.STM32F4DiscoveryBoard.WheelEncoder.value, '.-');
title('WheelEncoder', 'Interpreter', 'none');
xlabel('s');
ylabel('', 'Interpreter', 'none');
end
