#!/bin/bash
# Completion of the command line: what bash offers is what --help lists, and the values of the tables;
# in zsh and fish, where they are here, the same words.
# shellcheck disable=SC1091,SC2154
. tests/script.sh
out=$(dirname "${BUILD:-build/release}")/completion
. "$out/gnomon.bash"

# offered WORD..: what bash completes the last word to, in lines
offered() {
    COMP_WORDS=(gnomon "$@") COMP_CWORD=$#
    _gnomon 2> /dev/null
    printf '%s\n' "${COMPREPLY[@]}"
}

# offers EXPECTED WORD..: exactly those, in any order
offers() {
    local expected=$1 got
    shift
    got=$(offered "$@" | sort | xargs)
    expected=$(printf '%s\n' $expected | sort | xargs)
    [ "$got" = "$expected" ] || complain "gnomon $*: offers '$got', expected '$expected'"
}

for command in '' $(commands_of); do
    options=$("$gnomon" $command --help=all | sed -nE 's/^(      |  -[a-zA-Z], )(--[a-z-]+(=all)?).*/\2/p')
    offers "$options" $command --
    [ "$(wc -w <<< "$options")" -ge 4 ] || complain "options of $command"
done
offers 'pcss' render --shadow pcs
offers 'pcf,pcss' bench --shadow pcf,pcs
offers 'pcss' render --shadow = pcs
offers '0 90 180 270' show --rotate ''
offers 'lesson' les
offers 'help' hel
offers 'scene screenshot set status sun' ctl s
offers 'shadow shadow-strength shadow-specular' ctl set shadow
offers 'smsm' ctl set shadow sm
offers '' ctl status ''
offers 'compare' help comp
offers 'techniques' help tech
offers 'acne' lesson acn
offers 'maps_mb=' render --limit maps
offers '' render --size ''
offers 'depth-compare' doctor --without dep
cd "$folder" || exit 1
touch 'a scene.glb' && mkdir scenes
offers 'a scene.glb' a
offers 'scenes' bench sc
offers 'scenes' render -o sc
offers 'studio' render --environment st
cd - > /dev/null || exit 1

# ---- the other shells ------------------------------------------------------------------------------
if command -v fish > /dev/null; then
    fish_offers() {
        local got
        got=$(HOME=$folder fish --no-config -c "source $out/gnomon.fish; complete -C '$1'" 2>&1 | cut -f 1 | sort | xargs)
        [ "$got" = "$2" ] || complain "fish: $1: offers '$got', expected '$2'"
    }
    fish_offers 'gnomon render --shadow pcs' 'pcss'
    fish_offers 'gnomon render --shadow-st' '--shadow-strength'
    fish_offers 'gnomon doctor --shadow-st' ''
    fish_offers 'gnomon les' 'lesson'
    fish_offers 'gnomon help tech' 'techniques'
    fish_offers 'gnomon ctl sta' 'status'
    fish_offers 'gnomon ctl set shadow-st' 'shadow-strength'
    fish_offers 'gnomon ctl --json screens' 'screenshot'
fi
if command -v zsh > /dev/null; then
    # a terminal of its own, in which the tab key is pressed
    zsh_offers() {
        local got
        got=$(zsh -f tests/completion.zsh "$out/gnomon.zsh" "$1" 2>&1)
        [ "${got%[ =,]}" = "$2" ] || complain "zsh: $1 becomes '$got', expected '$2'"
    }
    zsh_offers 'gnomon render --shadow-st' 'gnomon render --shadow-strength'
    zsh_offers 'gnomon render --shadow pcs' 'gnomon render --shadow pcss'
    zsh_offers 'gnomon les' 'gnomon lesson'
    zsh_offers 'gnomon lesson acn' 'gnomon lesson acne'
    zsh_offers 'gnomon ctl screens' 'gnomon ctl screenshot'
    zsh_offers 'gnomon ctl set shadow-st' 'gnomon ctl set shadow-strength'
    zsh_offers 'gnomon ctl set shadow sms' 'gnomon ctl set shadow smsm'
fi
exit "$bad"
