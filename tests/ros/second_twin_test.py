"""A second twin, or a bridge, on the topics or the LCM channels of a twin is named in the log and in /diagnostics, also
where the two share nothing but LCM; when it is gone that is over."""
import os


from node_trial import ERROR, OK, SCENES, NodeTrial, load_scene, wait_until

BOTH = r'2 twins on the LCM channels TWIN_\*: (?=.*/simulation_node on)(?=.*/other/simulation_node on)'
NAMED = '/%s publishes on topics of this node'


class SecondTwin(NodeTrial):
    def setUp(self):
        super().setUp()
        for twin in ('/twin', '/other'):
            load_scene(os.path.join(SCENES, 'demo.yaml'), twin)

    def expect_diagnosed(self, name, level, pattern=''):
        self.assertTrue(wait_until(lambda: self.diagnosed(name, level, pattern)), (name, pattern, self.status))

    def expect_said(self, process, pattern):
        self.assertTrue(wait_until(lambda: self.says(process, pattern)), (pattern, self.log(process)))

    def test_on_lcm_alone(self):
        first = self.start('simulation_node', '_realtime:=ignore')
        self.expect_diagnosed('simulation_node: LCM channels', OK)
        other = self.start('simulation_node', '_realtime:=ignore', '_lcm_prefix:=TWIN_', '__ns:=/other')
        self.start('lcm_bridge_node', '_lcm_prefix:=TWIN_', '__ns:=/third')
        for process in (first, other):
            self.expect_said(process, BOTH)
        for node in ('simulation_node', 'other/simulation_node', 'third/lcm_bridge_node'):
            self.expect_diagnosed(node + ': LCM channels', ERROR, BOTH)
        self.end(other)
        self.expect_diagnosed('simulation_node: LCM channels', OK)

    def test_on_topics(self):
        first = self.start('simulation_node', '_realtime:=ignore', '_lcm_url:=')
        self.expect_diagnosed('simulation_node: ROS master', OK)
        second = self.start('simulation_node', '_realtime:=ignore', '_lcm_url:=', '__name:=intruder')
        for node, rival, process in (('simulation_node', 'intruder', first), ('intruder', 'simulation_node', second)):
            self.expect_said(process, NAMED % rival)
            self.expect_diagnosed(node + ': ROS master', ERROR, NAMED % rival)
        self.end(second)
        self.expect_diagnosed('simulation_node: ROS master', OK)

    def test_a_bridge_beside_a_twin(self):
        twin = self.start('simulation_node', '_realtime:=ignore')
        self.expect_diagnosed('simulation_node: ROS master', OK)
        self.start('lcm_bridge_node')
        self.expect_said(twin, NAMED % 'lcm_bridge_node')
        for node, rival in (('simulation_node', 'lcm_bridge_node'), ('lcm_bridge_node', 'simulation_node')):
            self.expect_diagnosed(node + ': ROS master', ERROR, NAMED % rival)
