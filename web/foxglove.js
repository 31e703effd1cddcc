// A client of Foxglove's WebSocket protocol: channels in JSON, parameters, services.

const MESSAGE = 1;
const SERVICE_RESPONSE = 3;
const SERVICE_REQUEST = 2;

export class Client {
  /// on: functions open(serverInfo), channels(), close(), status(text), parameters(values).
  constructor(url, on) {
    this.url = url;
    this.on = on;
    this.decoder = new TextDecoder();
    this.connect();
  }

  connect() {
    this.channels = new Map();  // by topic
    this.handlers = new Map();  // by subscription
    this.services = new Map();  // by name
    this.calls = new Map();
    this.last = 0;
    const socket = new WebSocket(this.url, ["foxglove.sdk.v1"]);
    socket.binaryType = "arraybuffer";
    socket.onmessage = event =>
      typeof event.data === "string" ? this.text(JSON.parse(event.data)) : this.binary(event.data);
    socket.onclose = () => {
      for (const call of this.calls.values()) {
        call.reject(new Error("the connection is lost"));
      }
      this.on.close();
      setTimeout(() => this.connect(), 1000);
    };
    this.socket = socket;
  }

  text(message) {
    switch (message.op) {
      case "serverInfo": this.on.open(message); break;
      case "advertise":
        message.channels.forEach(channel => this.channels.set(channel.topic, channel.id));
        this.on.channels();
        break;
      case "advertiseServices":
        message.services.forEach(service => this.services.set(service.name, service.id));
        break;
      case "status": this.on.status(message.message); break;
      case "parameterValues": this.on.parameters(message.parameters); break;
      case "serviceCallFailure":
        this.calls.get(message.callId)?.reject(new Error(message.message));
        this.calls.delete(message.callId);
        break;
    }
  }

  binary(buffer) {
    const view = new DataView(buffer);
    if (view.getUint8(0) === MESSAGE) {
      const handler = this.handlers.get(view.getUint32(1, true));
      handler?.(JSON.parse(this.decoder.decode(new Uint8Array(buffer, 13))));
    } else if (view.getUint8(0) === SERVICE_RESPONSE) {
      const call = view.getUint32(5, true);
      const answer = JSON.parse(this.decoder.decode(new Uint8Array(buffer, 13 + view.getUint32(9, true))));
      answer.success ? this.calls.get(call)?.resolve(answer)
                     : this.calls.get(call)?.reject(new Error(answer.message));
      this.calls.delete(call);
    }
  }

  send(message) {
    if (this.socket.readyState === WebSocket.OPEN) {
      this.socket.send(typeof message === "object" && message.op ? JSON.stringify(message) : message);
    }
  }

  /// The handler gets every message of a topic; nothing happens if there is no such topic.
  subscribe(topic, handler) {
    const channelId = this.channels.get(topic);
    if (channelId !== undefined) {
      const id = ++this.last;
      this.handlers.set(id, handler);
      this.send({op: "subscribe", subscriptions: [{id, channelId}]});
    }
  }

  watchParameters() {
    this.send({op: "subscribeParameterUpdates", parameterNames: []});
    this.send({op: "getParameters", parameterNames: [], id: "all"});
  }

  setParameter(name, value) {
    this.send({op: "setParameters", parameters: [{name, value}], id: `${++this.last}`});
  }

  /// Resolves with the answer of a service, rejects with why it did nothing.
  call(service, request) {
    const encoding = new TextEncoder().encode("json");
    const body = new TextEncoder().encode(JSON.stringify(request));
    const out = new Uint8Array(13 + encoding.length + body.length);
    const view = new DataView(out.buffer);
    const call = ++this.last;
    view.setUint8(0, SERVICE_REQUEST);
    view.setUint32(1, this.services.get(service) ?? 0xffffffff, true);
    view.setUint32(5, call, true);
    view.setUint32(9, encoding.length, true);
    out.set(encoding, 13);
    out.set(body, 13 + encoding.length);
    return new Promise((resolve, reject) => {
      this.calls.set(call, {resolve, reject});
      this.send(out);
    });
  }
}
