"""What trials of real processes have in common: nodes started one by one, what they say in their logs and in
/diagnostics, and that all of them end."""
import os
import re
import signal
import subprocess
import tempfile
import time
import unittest

import roslib.packages
import rospkg
import rospy
from diagnostic_msgs.msg import DiagnosticArray

PATIENCE = 30.0  # s
SCENES = os.path.join(rospkg.RosPack().get_path('whirl_twin'), 'config', 'scenes')
OK, WARN, ERROR = 0, 1, 2  # levels of diagnostics


def wait_until(condition, patience=PATIENCE):
    end = time.monotonic() + patience
    while not condition() and time.monotonic() < end:
        time.sleep(0.1)
    return condition()


def load_scene(scene, twin='/twin'):
    subprocess.check_call(['rosparam', 'load', scene, twin + '/scene'])


class NodeTrial(unittest.TestCase):
    def setUp(self):
        self.processes = []
        self.subscribers = []
        self.folder = tempfile.TemporaryDirectory()
        self.status = {}
        self.listen('/diagnostics', DiagnosticArray, self.take_diagnostics)

    def tearDown(self):
        for subscriber in self.subscribers:
            subscriber.unregister()
        for process, _ in self.processes:
            if process.poll() is None:
                process.send_signal(signal.SIGCONT)
                process.send_signal(signal.SIGINT)
        for process, _ in self.processes:
            process.wait(20)
        self.folder.cleanup()

    def listen(self, topic, kind, callback):
        self.subscribers.append(rospy.Subscriber(topic, kind, callback))

    def take_diagnostics(self, message):
        for status in message.status:
            self.status[status.name] = status

    def start(self, node, *arguments, **environment):
        program = roslib.packages.find_node('whirl_twin', node)[0]
        name = os.path.join(self.folder.name, str(len(self.processes)))
        with open(name, 'w') as log:
            process = subprocess.Popen([program] + list(arguments), env=dict(os.environ, **environment), stdout=log,
                                       stderr=subprocess.STDOUT)
        self.processes.append((process, name))
        return self.processes[-1]

    def end(self, process):
        process[0].send_signal(signal.SIGINT)
        process[0].wait(20)

    def log(self, process):
        with open(process[1], errors='replace') as log:
            return log.read()

    def says(self, process, pattern):
        """A line of its log so far."""
        return re.search(pattern, self.log(process))

    def diagnosed(self, name, level, pattern=''):
        """/diagnostics of `node: task` say so at present."""
        status = self.status.get(name)
        return status and status.level == level and re.search(pattern, status.message)
