"""What trials of real processes have in common: nodes started one by one, what they say in their logs and in
/diagnostics, and that nothing of a trial is left for the next one, which has the same master: processes, parameters,
subscriptions."""
import functools
import os
import re
import signal
import subprocess
import tempfile
import time
import unittest

import roslib.packages
import rosparam
import rospkg
import rospy
from diagnostic_msgs.msg import DiagnosticArray

PATIENCE = 30.0  # s
PACKAGE = rospkg.RosPack().get_path('whirl_twin')
SCENES = os.path.join(PACKAGE, 'config', 'scenes')
TRIAL_SCENES = os.path.join(PACKAGE, 'tests', 'ros', 'scenes')
MOST = 4000  # characters of a log that are shown
COLOUR = re.compile('\x1b\\[[0-9;]*m')  # rosconsole's, which no report in XML may have
OK, WARN, ERROR = 0, 1, 2  # levels of diagnostics
OF_THE_MASTER = {'rosdistro', 'roslaunch', 'rosversion', 'run_id'}  # parameters


def wait_until(condition, patience=PATIENCE):
    end = time.monotonic() + patience
    while not condition() and time.monotonic() < end:
        time.sleep(0.05)
    return condition()


def call(name, kind, *request):
    rospy.wait_for_service(name, PATIENCE)
    return rospy.ServiceProxy(name, kind)(*request)


def load_parameters(file, namespace):
    (parameters, _), = rosparam.load_file(file)
    rosparam.upload_params(namespace, parameters)


def load_scene(scene, twin='/twin'):
    """As demo.launch does; in place of the one before."""
    if rospy.has_param(twin + '/scene'):
        rospy.delete_param(twin + '/scene')
    load_parameters(scene, twin + '/scene')
    rospy.set_param(twin + '/scene_file', scene)


def forget_parameters():
    for name in {name.split('/')[1] for name in rospy.get_param_names()} - OF_THE_MASTER:
        rospy.delete_param('/' + name)


def with_logs(test):
    """A test that, failing, also shows what its processes have said: nothing else of them is left."""
    @functools.wraps(test)
    def run(self):
        try:
            test(self)
        except AssertionError as error:
            logs = ['\n%s\n%s' % (process[0].args, self.log(process)[-MOST:]) for process in self.processes]
            error.args = (str(error) + ''.join(logs),)
            raise
    return run


class NodeTrial(unittest.TestCase):
    def __init_subclass__(cls):
        for name, test in list(vars(cls).items()):
            if name.startswith('test_'):
                setattr(cls, name, with_logs(test))

    def setUp(self):
        forget_parameters()
        self.processes = []
        self.subscribers = []
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)  # who is ended may still write there
        self.status = {}
        self.addCleanup(self.clear_away)
        self.listen('/diagnostics', DiagnosticArray, self.take_diagnostics)

    def clear_away(self):
        for subscriber in self.subscribers:
            subscriber.unregister()
        left = [process for process, _ in reversed(self.processes) if process.poll() is None]
        for process in left:
            process.send_signal(signal.SIGCONT)
            process.send_signal(signal.SIGINT)
        deaf = []
        for process in left:
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                deaf.append(process.args)
                process.kill()
                process.wait()
        self.folder.cleanup()
        self.assertFalse(deaf, 'they did not end')

    def listen(self, topic, kind, callback, *arguments):
        self.subscribers.append(rospy.Subscriber(topic, kind, callback, *arguments))
        return self.subscribers[-1]

    def publisher(self, topic, kind, queue_size=10):
        publisher = rospy.Publisher(topic, kind, queue_size=queue_size)
        self.addCleanup(publisher.unregister)
        return publisher

    def take_diagnostics(self, message):
        for status in message.status:
            self.status[status.name] = status

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def start(self, node, *arguments, **environment):
        return self.start_program(roslib.packages.find_node('whirl_twin', node)[0], *arguments, **environment)

    def start_program(self, *command, **environment):
        name = self.path('log%d' % len(self.processes))
        with open(name, 'w') as log:
            process = subprocess.Popen(command, env=dict(os.environ, **environment), stdout=log,
                                       stderr=subprocess.STDOUT)
        self.processes.append((process, name))
        return self.processes[-1]

    def end(self, process):
        """Its exit status."""
        process[0].send_signal(signal.SIGINT)
        return process[0].wait(60)

    def log(self, process):
        with open(process[1], errors='replace') as log:
            return COLOUR.sub('', log.read())

    def says(self, process, pattern):
        """A line of its log so far."""
        return re.search(pattern, self.log(process))

    def diagnosed(self, name, level, pattern=''):
        """/diagnostics of `node: task` say so at present."""
        status = self.status.get(name)
        return status and status.level == level and re.search(pattern, status.message)
