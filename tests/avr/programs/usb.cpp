// Sends back what it receives, one more each, over USB; the LED shows whether the port is open.
#include <Arduino.h>

void setup() {
  Serial.begin(115200);
  pinMode(LED_BUILTIN, OUTPUT);
}

void loop() {
  digitalWrite(LED_BUILTIN, Serial.dtr() ? HIGH : LOW);
  while (Serial.available() > 0) {
    Serial.write((uint8_t)(Serial.read() + 1));
  }
}
