function plot_miniature_car(file)
% Plots a record of the design miniature_car: plot_miniature_car('run.mcap'). Generated: copy it to start a
% script of your own.
if nargin < 1
    help plot_miniature_car
    return;
end
run = read_record(file);

figure('Name', 'STM32F4DiscoveryBoard');
subplot(5, 3, 1);
plot(run.STM32F4DiscoveryBoard.IRFrontRight.t, run.STM32F4DiscoveryBoard.IRFrontRight.value, '.-');
title('IRFrontRight', 'Interpreter', 'none');
xlabel('s');
ylabel('', 'Interpreter', 'none');
subplot(5, 3, 2);
plot(run.STM32F4DiscoveryBoard.IRRearRight.t, run.STM32F4DiscoveryBoard.IRRearRight.value, '.-');
title('IRRearRight', 'Interpreter', 'none');
xlabel('s');
ylabel('', 'Interpreter', 'none');
subplot(5, 3, 3);
plot(run.STM32F4DiscoveryBoard.IRRear.t, run.STM32F4DiscoveryBoard.IRRear.value, '.-');
title('IRRear', 'Interpreter', 'none');
xlabel('s');
ylabel('', 'Interpreter', 'none');
subplot(5, 3, 4);
plot(run.STM32F4DiscoveryBoard.USFront.t, run.STM32F4DiscoveryBoard.USFront.value, '.-');
title('USFront', 'Interpreter', 'none');
xlabel('s');
ylabel('cm', 'Interpreter', 'none');
subplot(5, 3, 5);
plot(run.STM32F4DiscoveryBoard.USFrontRight.t, run.STM32F4DiscoveryBoard.USFrontRight.value, '.-');
title('USFrontRight', 'Interpreter', 'none');
xlabel('s');
ylabel('cm', 'Interpreter', 'none');
subplot(5, 3, 6);
plot(run.STM32F4DiscoveryBoard.USRear.t, run.STM32F4DiscoveryBoard.USRear.value, '.-');
title('USRear', 'Interpreter', 'none');
xlabel('s');
ylabel('cm', 'Interpreter', 'none');
subplot(5, 3, 7);
plot(run.STM32F4DiscoveryBoard.WheelLeftA.t, run.STM32F4DiscoveryBoard.WheelLeftA.value, '.-');
title('WheelLeftA', 'Interpreter', 'none');
xlabel('s');
ylabel('', 'Interpreter', 'none');
subplot(5, 3, 8);
plot(run.STM32F4DiscoveryBoard.WheelLeftB.t, run.STM32F4DiscoveryBoard.WheelLeftB.value, '.-');
title('WheelLeftB', 'Interpreter', 'none');
xlabel('s');
ylabel('', 'Interpreter', 'none');
subplot(5, 3, 9);
plot(run.STM32F4DiscoveryBoard.WheelRightA.t, run.STM32F4DiscoveryBoard.WheelRightA.value, '.-');
title('WheelRightA', 'Interpreter', 'none');
xlabel('s');
ylabel('', 'Interpreter', 'none');
subplot(5, 3, 10);
plot(run.STM32F4DiscoveryBoard.WheelRightB.t, run.STM32F4DiscoveryBoard.WheelRightB.value, '.-');
title('WheelRightB', 'Interpreter', 'none');
xlabel('s');
ylabel('', 'Interpreter', 'none');
subplot(5, 3, 11);
plot(run.STM32F4DiscoveryBoard.RCSteering.t, run.STM32F4DiscoveryBoard.RCSteering.value, '.-');
title('RCSteering', 'Interpreter', 'none');
xlabel('s');
ylabel('us', 'Interpreter', 'none');
subplot(5, 3, 12);
plot(run.STM32F4DiscoveryBoard.RCThrottle.t, run.STM32F4DiscoveryBoard.RCThrottle.value, '.-');
title('RCThrottle', 'Interpreter', 'none');
xlabel('s');
ylabel('us', 'Interpreter', 'none');
subplot(5, 3, 13);
plot(run.STM32F4DiscoveryBoard.RCSwitch.t, run.STM32F4DiscoveryBoard.RCSwitch.value, '.-');
title('RCSwitch', 'Interpreter', 'none');
xlabel('s');
ylabel('us', 'Interpreter', 'none');
end
