"""Starts the nodes of sense_curves. Written by SenseDSL; copy it to start a launch file of your own."""
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("rover_port", default_value="/dev/ttyACM0"),
        Node(
            package="sense_curves",
            executable="rover",
            name="rover",
            parameters=[{"port": LaunchConfiguration("rover_port")}],
            output="screen",
        ),
    ])
