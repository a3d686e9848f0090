#pragma once

/// \file
/// A network of a test's own: a namespace with nothing but loopback, at 127.0.0.1 and 127.0.0.2.
/// GigE Vision devices answer on a fixed port and are looked for by broadcasts, so tests that serve
/// cameras would meet each other and the host's real ones. Needs no rights where the kernel permits
/// user namespaces, and otherwise root; a test that can have neither is skipped and says so.

#include <string>

namespace ringhook::test {

/// Puts this process, which must have one thread yet, into such a network, once. Empty on success,
/// else why not.
const std::string& ownNetwork();

}  // namespace ringhook::test
