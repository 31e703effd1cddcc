#!/usr/bin/python3
"""A growing CSV file, or what an acquisition card's program writes into a pipe, as whirl_twin/Measurement on ROS.

usage: csv_to_ros.py FILE|- SOURCE [--quiet S] [--pace P] [--plain]

The first line has names with units, time,probe_x[m],probe_y[m]; time: s of the machine's clock. What is no number is
sent as invalid; a row not later than the one before is left out, and said; two columns of one name end it at once. It
ends with the pipe, or when the file has not grown for S seconds, which may be left out. --pace plays a record P times as
fast as it was made. --plain needs no ROS: a block a line, as JSON, on standard output.
"""
import argparse
import decimal
import json
import math
import re
import sys
import time

LONGEST = 50_000_000  # ns, of a block
MOST_ROWS = 500  # of a block


def rows(file, quiet):
    """Each line as its columns once all of it is there; None where there is no more for now."""
    line, grown = '', time.monotonic()
    while True:
        part = file.readline()
        line += part
        if line.endswith('\n'):
            yield line.strip().split(',')
            line, grown = '', time.monotonic()
        elif not part:
            yield None
            if time.monotonic() - grown >= quiet:
                return
            time.sleep(0.01)


def number(text):
    try:
        return float(text) if math.isfinite(float(text)) else math.nan
    except ValueError:
        return math.nan


def blocks(file, quiet):
    """The fields of a Measurement, as often as there is news; its step counts, so that a loss is seen."""
    names, block, newest, sent, step = None, [], -math.inf, 0, 0  # ns
    for row in rows(file, quiet):
        if row and names is None:
            names = [re.fullmatch(r'(\w+)(?:\[(.*)\])?', name.strip()).groups('') for name in row[1:]]
            channels = [name for name, _ in names]
            again = [i for i, name in enumerate(channels) if channels.index(name) < i]
            for i in again:
                print(f'line 1: columns {channels.index(channels[i]) + 2} and {i + 2} are called {channels[i]}',
                      file=sys.stderr)
            if again:
                sys.exit(2)
        elif row:
            instant = None if math.isnan(number(row[0])) else int(decimal.Decimal(row[0]).scaleb(9))  # exactly
            if instant is None or instant <= newest:
                print('left out, without a time or not later than the row before:', ','.join(row), file=sys.stderr)
                continue
            newest = instant
            block.append((instant, [number(text) for text in (row[1:] + [''] * len(names))[:len(names)]]))
        if block and (row is None or newest - sent >= LONGEST or len(block) >= MOST_ROWS):
            values = [value for _, row_values in block for value in row_values]
            yield {'step': step, 'time': 1e-9 * newest, 'channel': [name for name, _ in names],
                   'unit': [unit for _, unit in names], 'deviation': [math.nan] * len(names),  # put your probes' here
                   'samples': len(block), 'first_instant': block[0][0], 'period': 0,
                   'instant': [instant for instant, _ in block], 'value': values,
                   'valid': [not math.isnan(value) for value in values]}
            block, sent, step = [], newest, step + 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('file')
    parser.add_argument('source')
    parser.add_argument('--quiet', type=float, default=math.inf)
    parser.add_argument('--pace', type=float, default=0.0)
    parser.add_argument('--plain', action='store_true')
    told = parser.parse_args([a for a in sys.argv[1:] if not re.match(r'_\w+:=', a)])  # roslaunch adds __name:=
    file, quiet = (sys.stdin, 0.0) if told.file == '-' else (open(told.file), told.quiet)
    if told.plain:
        for block in blocks(file, quiet):
            for name in 'value', 'deviation':
                block[name] = [None if math.isnan(value) else value for value in block[name]]
            print(json.dumps({'source': told.source, **block}), flush=True)
        return
    import rospy  # pylint: disable=import-outside-toplevel
    from whirl_twin.msg import Measurement
    rospy.init_node('csv_to_ros', anonymous=True)
    machine = rospy.get_namespace() if rospy.get_namespace() != '/' else '/twin/'
    topic = rospy.Publisher(machine + 'measured/' + told.source, Measurement, queue_size=100)
    while topic.get_num_connections() == 0 and not rospy.is_shutdown():
        time.sleep(0.05)  # until somebody listens: else the first blocks would be lost
    start = None
    for block in blocks(file, quiet):
        newest = 1e-9 * block['instant'][-1]
        start = start or (time.monotonic(), newest)
        if told.pace > 0.0 and not rospy.is_shutdown():
            time.sleep(max(0.0, start[0] + (newest - start[1]) / told.pace - time.monotonic()))
        message = Measurement(**block)
        message.header.stamp, message.header.frame_id = rospy.Time.now(), told.source
        topic.publish(message)


if __name__ == '__main__':
    main()
