"""Starts the nodes of sense_miniature_car. Written by SenseDSL; copy it to start a launch file of your own."""
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("stm32f4discoveryboard_port", default_value="/dev/ttyACM0"),
        Node(
            package="sense_miniature_car",
            executable="stm32f4discoveryboard",
            name="stm32f4discoveryboard",
            parameters=[{"port": LaunchConfiguration("stm32f4discoveryboard_port")}],
            output="screen",
        ),
    ])
