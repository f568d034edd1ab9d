"""The wire: an arm of hobby servos, real or virtual. Codecs (bytes ↔ commands), driver, virtual arm, links.

Importing it makes pyserial know the virtual arm: `serial.serial_for_url("al5b://")` (protocol_al5b.py has its options).
"""

import serial

if __name__ not in serial.protocol_handler_packages:
    serial.protocol_handler_packages.append(__name__)
