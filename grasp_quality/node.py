# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Entry point of the executable grasp_quality_node.

Spins a single-threaded executor (the multi-threaded one stalls on Jazzy), ends on SIGINT and
SIGTERM alike with exit code 0, and says NOT_ACTIVE with empty forces before it goes.
"""

import signal
import sys

MISSING_INTERFACES = (
    'grasp_quality_node: the interface package grasp_quality_msgs is not built or not sourced: in '
    'a workspace run `colcon build --base-paths src "src/*/*"` and source install/setup.bash '
    '(README, "In a ROS 2 workspace"); in a clone run `make setup` and `. ./env.sh`')

NO_LOG_FILE = ('--ros-args', '--disable-external-lib-logs', '--')


def main(args=None):
    """Run the node until a signal comes; return the process's exit code."""
    try:
        import grasp_quality_msgs  # noqa: F401
    except ImportError:
        _say(MISSING_INTERFACES)
        return 1
    import rclpy
    from rclpy.executors import SingleThreadedExecutor
    from rclpy.signals import SignalHandlerOptions

    stopping = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: stopping.append(True))
    try:
        _init(rclpy, sys.argv if args is None else args, SignalHandlerOptions.NO)
    except Exception as exc:  # RCLError, UnknownROSArgsError, ...: no common base
        _say(f'grasp_quality_node: {type(exc).__name__}: {exc}')
        return 1
    try:
        node = _make_node()
        if node is None:
            return 1
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        while not stopping and rclpy.ok():
            _spin_once(executor, node)
        node.silence('the node is ending')
        executor.shutdown()
        node.destroy_node()
    finally:
        rclpy.try_shutdown()
        for number in (signal.SIGINT, signal.SIGTERM):  # one more while Python ends is no crash
            signal.signal(number, signal.SIG_IGN)
        _let_go_of_output()
    return 0


def _say(text):
    try:
        print(text, file=sys.stderr, flush=True)
    except OSError:  # whoever listens is gone, or the disk is full
        pass


def _let_go_of_output():
    """Drop what cannot be printed: Python would try again at its end, and exit with code 120."""
    for name in ('stdout', 'stderr'):
        try:
            getattr(sys, name).flush()
        except OSError:
            setattr(sys, name, None)


def _init(rclpy, args, signals):
    """Begin with ROS; without its log file where none can be made, as on a full disk."""
    from rclpy.utilities import get_default_context
    try:
        rclpy.init(args=args, signal_handler_options=signals)
    except Exception as exc:
        if 'logging' not in str(exc):
            raise
        _say(f'grasp_quality_node: goes on without a log file: {exc}')
        get_default_context(shutting_down=True)  # a context can begin once only: take another
        rclpy.init(args=[*args, *NO_LOG_FILE], signal_handler_options=signals)


def _make_node():
    from rclpy.lifecycle import TransitionCallbackReturn

    from grasp_quality.lifecycle_node import GraspQualityNode
    try:
        node = GraspQualityNode()
    except Exception as exc:  # ValueError, ParameterException, RCLError of the middleware, ...
        _say(f'grasp_quality_node: {exc}')
        return None
    if node.settings.autostart:
        done = node.trigger_configure() == TransitionCallbackReturn.SUCCESS \
            and node.trigger_activate() == TransitionCallbackReturn.SUCCESS
        node.get_logger().info('active' if done else 'autostart failed: configure it by hand')
    else:
        node.get_logger().info('not active: waits to be configured and activated (autostart)')
    return node


def _spin_once(executor, node):
    """Run what is ready; the watchdog timer bounds how long this waits."""
    try:
        executor.spin_once()
    except Exception as exc:  # of rclpy itself: our callbacks let nothing out
        node.get_logger().error(
            f'the executor raised {type(exc).__name__}: {exc}', throttle_duration_sec=1.0)


if __name__ == '__main__':
    sys.exit(main())
