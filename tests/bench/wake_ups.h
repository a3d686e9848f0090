#pragma once

namespace ringhook::bench {

/// Times so many answers of our client, from the controller's feedback on the wire to the command
/// on the wire, beside a bare echo of as many bytes; prints percentiles of both and their ratio.
void compareWakeUps(int cycles);

}  // namespace ringhook::bench
