/* What the firmware of a tracking box has to do, apart from its pins: protocol version 1 in portable C99. No
 * allocation, no floating point arithmetic, no interrupts of its own; some 400 bytes of memory. All calls from one
 * context.
 *
 * A board's program does this:
 *   - at power-up: box_init with the record that flash holds; the clamps' outputs open in hardware;
 *   - every 1 / rate_hz, by a timer: reads its sensors, box_sample, puts the 64 bytes into the IN endpoint in place of
 *     what the host has not fetched (counting that in `overruns`), and drives the clamps by box_clamp (and by
 *     box_rotary_clamp where turning has a brake of its own: the program then sets separate_brakes after box_init);
 *   - for each packet of the OUT endpoint: box_take;
 *   - for each vendor request to the interface: box_control; -1 is a stall; after BOX_COMMIT_CALIBRATION writes
 * `record` to flash;
 *   - on suspend, reset, unplug: box_release. */
#ifndef OSTIUM_BOX_H
#define OSTIUM_BOX_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
  BOX_TRACKS = 4,
  BOX_IN_BYTES = 64,
  BOX_OUT_BYTES = 16,
  BOX_BRAKE_BYTES = 24,
  BOX_RECORD_BYTES = 128,
  BOX_FIRMWARE = 2
};

enum {
  BOX_INFO = 1,
  BOX_READ_CALIBRATION,
  BOX_WRITE_CALIBRATION,
  BOX_COMMIT_CALIBRATION,
  BOX_ZERO,
  BOX_WATCHDOG_TIME,
  BOX_RATE,
  BOX_STATISTICS
};

/* What the pins say at one moment. Counts are absolute and wrap. */
struct box_sensors {
  int32_t insertion[BOX_TRACKS], roll[BOX_TRACKS];
  uint8_t quality[BOX_TRACKS]; /* 0: no tool */
  uint8_t tool[BOX_TRACKS];    /* 0 none, 1 guide, 2 wire, 3 shaft, 4 second wire */
  int16_t pressure, flow;
  uint16_t pedals;
  uint8_t emergency_stop, over_temperature;
};

struct box {
  uint8_t record[BOX_RECORD_BYTES], written[BOX_RECORD_BYTES];
  uint8_t calibrated, has_written;
  uint8_t armed, arm_was_low, watchdog_released, any_out, stopped;
  uint8_t separate_brakes; /* set by the board's program */
  uint16_t clamp[BOX_TRACKS], rotary[BOX_TRACKS];
  uint16_t rate_hz, watchdog_ms, overruns, last_out_sequence;
  uint32_t sequence, now_us, last_out_us;
  uint32_t sent, taken, ignored, releases;
  int32_t zero_insertion[BOX_TRACKS], zero_roll[BOX_TRACKS];
  int32_t insertion[BOX_TRACKS], roll[BOX_TRACKS]; /* of the last sample */
};

/* `record`: 128 bytes of flash; anything that is no valid record: never calibrated. */
void box_init(struct box* box, const uint8_t* record);
/* A sample at `now_us`, which wraps, as the IN report of it. */
void box_sample(struct box* box, const struct box_sensors* sensors, uint32_t now_us, uint8_t report[BOX_IN_BYTES]);
void box_take(struct box* box, const uint8_t* bytes, size_t count);
/* `data`: of a request that brings some, else null. Returns how many bytes of `reply` answer it, or -1: stall. */
int box_control(struct box* box, uint8_t request, uint16_t value, const uint8_t* data, uint16_t count,
                uint8_t reply[BOX_RECORD_BYTES]);
void box_release(struct box* box);
/* What the track's clamp is to hold, of 65535; 0 is open. With separate brakes: that for pushing, and that for turning.
 */
uint16_t box_clamp(const struct box* box, int track);
uint16_t box_rotary_clamp(const struct box* box, int track);

#ifdef __cplusplus
}
#endif
#endif
