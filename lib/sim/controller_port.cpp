#include "sim/controller_port.h"

#include <algorithm>

#include "core/error.h"

namespace ringhook {

Rx60Socket socketOf(rx60::Channel channel) {
  switch (channel) {
    case rx60::Channel::kMotion:
      return Rx60Socket::kMotion;
    case rx60::Channel::kState:
      return Rx60Socket::kState;
    case rx60::Channel::kIo:
      break;
  }
  return Rx60Socket::kIo;
}

ControllerPort::ControllerPort(Rx60Controller& controller, Rx60Plant& plant, Time start,
                               std::uint64_t seed)
    : controller_(controller),
      plant_(plant),
      now_(start),
      next_tick_(start + Rx60Controller::kTick) {
  plant_.advanceTo(start);
  for (Wire& wire : wires_) {
    wire.to_client = FaultyLine(seed++);
    wire.to_controller = FaultyLine(seed++);
  }
}

void ControllerPort::open() {
  close();
  if (openings_to_refuse_ > 0) {
    --openings_to_refuse_;
    throw DeviceError("The simulated controller refuses the connection.");
  }
  ++openings_;
  for (const rx60::Channel channel : rx60::kChannels) {
    at(socketOf(channel)).state = Line::kOpen;
    controller_.connect(socketOf(channel));
  }
}

void ControllerPort::close() noexcept {
  for (const rx60::Channel channel : rx60::kChannels) {
    Wire& wire = at(socketOf(channel));
    wire.state = Line::kClosed;
    wire.to_client.clear();
    wire.to_controller.clear();
    wire.arrived.clear();
    controller_.disconnect(socketOf(channel));
  }
}

void ControllerPort::cut(Rx60Socket socket) {
  Wire& wire = at(socket);
  if (wire.state != Line::kOpen) {
    return;
  }
  wire.state = Line::kCut;
  wire.to_client.clear();
  wire.to_controller.clear();
  controller_.disconnect(socket);
}

std::optional<std::size_t> ControllerPort::read(rx60::Channel channel, std::span<std::byte> into) {
  Wire& wire = at(socketOf(channel));
  if (wire.arrived.empty() && wire.state != Line::kOpen) {
    wire.state = wire.state == Line::kCut ? Line::kCutAndTold : wire.state;
    return std::nullopt;
  }
  const std::size_t count = std::min(into.size(), wire.arrived.size());
  const auto end = wire.arrived.begin() + static_cast<std::ptrdiff_t>(count);
  std::copy(wire.arrived.begin(), end, into.begin());
  wire.arrived.erase(wire.arrived.begin(), end);
  return count;
}

bool ControllerPort::write(rx60::Channel channel, std::span<const std::byte> frame) {
  Wire& wire = at(socketOf(channel));
  if (wire.state != Line::kOpen) {
    return false;
  }
  wire.to_controller.push(frame, now_);
  return true;
}

bool ControllerPort::wakes() const {
  return std::any_of(wires_.begin(), wires_.end(), [](const Wire& wire) {
    return !wire.arrived.empty() || wire.state == Line::kCut;
  });
}

Time ControllerPort::nextEvent() const {
  Time next = next_tick_;
  for (const Wire& wire : wires_) {
    next = std::min(next, wire.to_client.nextDelivery().value_or(next));
    next = std::min(next, wire.to_controller.nextDelivery().value_or(next));
  }
  return std::max(next, now_);
}

/// Both ways, what is due by now.
void ControllerPort::deliver() {
  for (const Rx60Socket socket : kRx60Sockets) {
    Wire& wire = at(socket);
    controller_.receive(socket, wire.to_controller.pop(now_));
    const std::vector<std::byte> arrived = wire.to_client.pop(now_);
    wire.arrived.insert(wire.arrived.end(), arrived.begin(), arrived.end());
  }
}

void ControllerPort::runTick() {
  next_tick_ = next_tick_ + Rx60Controller::kTick;
  if (on_tick_) {
    on_tick_(now_);
  }
  controller_.tick(now_);
  for (const Rx60Socket socket : kRx60Sockets) {
    for (const rx60::Frame& frame : controller_.takeOutput(socket)) {
      at(socket).to_client.push(frame.bytes(), now_);
    }
  }
}

void ControllerPort::wait(Time deadline) {
  deliver();
  while (!wakes() && now_ < deadline) {
    now_ = std::min(nextEvent(), deadline);
    deliver();
    if (now_ == next_tick_) {
      runTick();
      deliver();
    }
  }
  plant_.advanceTo(now_);
}

}  // namespace ringhook
