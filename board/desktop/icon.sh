#!/bin/sh
# Prints the icon as SVG: a horizontal sundial seen from above, north up. Its hour lines are those of
# 52 degrees north, tan(line) = sin(latitude) tan(15 degrees x hours from noon); the shadow is that of
# half past two.
set -eu
export LC_ALL=C
awk 'BEGIN {
    pi = atan2(0, -1); latitude = 52 * pi / 180; x = 64; y = 84
    print "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"128\" height=\"128\" viewBox=\"0 0 128 128\">"
    print "<circle cx=\"64\" cy=\"64\" r=\"60\" fill=\"#e9dfc8\" stroke=\"#8a7a5c\" stroke-width=\"4\"/>"
    for (hour = -6; hour <= 6; hour++) line(hour, 46, 54, "#8a7a5c", hour % 3 ? 2 : 4)
    shadow = direction(2.5)
    tip_x = x + 52 * sin(shadow); tip_y = y - 52 * cos(shadow)
    printf "<path d=\"M%.2f %.2fL%.2f %.2fL64 44Z\" fill=\"#3a3f4c\" fill-opacity=\".55\"/>\n", x, y, tip_x, tip_y
    print "<path d=\"M61 84L64 32L67 84Z\" fill=\"#c8742c\"/>"
    print "<circle cx=\"64\" cy=\"84\" r=\"5\" fill=\"#8a4a16\"/>"
    print "</svg>"
}
# from the north, clockwise, in radians
function direction(hour, angle) {
    angle = hour * 15 * pi / 180
    return atan2(sin(latitude) * sin(angle), cos(angle))
}
# the part of an hour line inside the ring of the dial, whose centre is (64, 64)
function line(hour, from, to, colour, width, a) {
    a = direction(hour)
    printf "<path d=\"M%.2f %.2fL%.2f %.2f\" stroke=\"%s\" stroke-width=\"%d\"/>\n",
        x + reach(a, from) * sin(a), y - reach(a, from) * cos(a), x + reach(a, to) * sin(a), y - reach(a, to) * cos(a), colour, width
}
# how far it is from the foot of the gnomon to the circle of that radius
function reach(a, radius, d) {
    d = y - 64
    return d * cos(a) + sqrt(radius * radius - d * d * sin(a) * sin(a))
}'
