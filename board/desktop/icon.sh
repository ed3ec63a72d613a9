#!/bin/sh
# Prints the icon as SVG: the gnomon of a sundial and its shadow on a plain disc. Three shapes, which are seen at 16 pixels, too.
cat << 'END'
<svg xmlns="http://www.w3.org/2000/svg" width="128" height="128" viewBox="0 0 128 128">
<circle cx="64" cy="64" r="60" fill="#f3e3bd"/>
<path d="M24 80L74 80L99 109Z" fill="#3a4256"/>
<path d="M24 80L74 12L74 80Z" fill="#b85c1a"/>
</svg>
END
